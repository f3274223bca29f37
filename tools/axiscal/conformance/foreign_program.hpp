#pragma once
// Asks another program: a case on its standard input, the result from its standard output.

#include "analysis/quantity/result.hpp"

#include <chrono>
#include <string>

namespace axiscal {

/// Runs `command` by `sh -c` in a process group of its own and returns what it wrote to standard
/// output. The group is killed at the end, so nothing outlives the question.
/// @errors Fault::io: it cannot be started. Fault::link_timeout: not finished after `limit`.
/// Fault::refused: ended with another code than 0, or by a signal, or wrote over 64 MiB; the last
/// line of its standard error is in the detail.
Result<std::string>
ask_program(const std::string& command, const std::string& input, std::chrono::milliseconds limit);

} // namespace axiscal
