#pragma once
// Starts axiscal-report, the short-lived process that draws: the daemon links no drawing library.

#include "acquisition/live/to_do.hpp"
#include "drivers/loop/scheduler.hpp"

#include <chrono>
#include <string>
#include <vector>

namespace axiscal {

inline constexpr std::chrono::milliseconds longest_drawing =
    std::chrono::minutes{2}; ///< it takes a second

struct WrittenCertificate {
    std::string entry;
    std::string verdict; ///< "R: fail", the figure that it rests on; empty without limits
    std::vector<std::string> setup_findings; ///< a sentence each (sentence_of); usually none
    std::vector<OpenFinding> unanswered;     ///< those of them that nobody answered
};

/// Runs `program run_file --outbox outbox` and waits for it without holding the loop; after `limit`
/// it is killed.
/// @returns the folder of the new outbox entry, and what the program said of verdict and set-up.
/// @errors Fault::io with the process's own last words.
Task<Result<WrittenCertificate>>
write_certificate(Scheduler& scheduler,
                  std::string program,
                  std::string run_file,
                  std::string outbox,
                  std::chrono::milliseconds limit = longest_drawing);

/// `name` beside this executable when it lies there, else just `name` (found by PATH).
std::string sibling_program(const std::string& name);

} // namespace axiscal
