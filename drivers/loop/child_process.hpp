#pragma once
// A program that the daemon starts: the report, the lock against falling asleep.

#include "analysis/quantity/result.hpp"

#include <cstdint>
#include <string>
#include <sys/types.h>
#include <vector>

namespace axiscal {

enum class ChildInput : std::uint8_t { inherited, pipe };

/// Whoever has it closes the descriptors and waits for `pid` when `process` is readable.
struct ChildProcess {
    pid_t pid = -1;
    int input = -1;   ///< write end of its stdin, where that is a pipe
    int output = -1;  ///< read end of its stdout and stderr
    int process = -1; ///< pidfd: readable when it has ended
};

/// `words`: the program, found by PATH, and its arguments. @errors Fault::io with its name
Result<ChildProcess> start_child(const std::vector<std::string>& words,
                                 ChildInput input = ChildInput::inherited);

/// Of all that a program said.
std::string last_line_of(std::string text);

} // namespace axiscal
