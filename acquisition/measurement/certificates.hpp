#pragma once
// Has certificates of closed runs made, and tells people what became of them.

#include "analysis/quantity/result.hpp"
#include "drivers/loop/scheduler.hpp"

#include <string>

namespace axiscal {

class Notices;

/// Loop-bound.
class Certificates {
public:
    /// @param report_program  its path, or its name, which is found by PATH
    /// @param outbox          folder that the certificates go into
    Certificates(Scheduler& scheduler,
                 Notices& notices,
                 std::string report_program,
                 std::string outbox);

    /// One process, of a second or so. Whoever asks keeps the answer: meanwhile another test may
    /// have begun.
    /// @returns the folder of the new outbox entry. @errors as write_certificate.
    Task<Result<std::string>> make(std::string run_id, std::string run_file);

private:
    Scheduler& scheduler_;
    Notices& notices_;
    std::string report_program_, outbox_;
};

} // namespace axiscal
