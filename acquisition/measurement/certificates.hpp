#pragma once
// Has certificates of closed runs made, and tells people what became of them.

#include "acquisition/live/to_do.hpp"
#include "analysis/quantity/result.hpp"
#include "drivers/loop/scheduler.hpp"

#include <string>
#include <vector>

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

    /// Findings about the set-up on the certificate that was made last, which nobody answered;
    /// none where it is another run's.
    [[nodiscard]] std::vector<OpenFinding> unanswered_of(const std::string& run_id) const {
        return run_id == made_of_ ? unanswered_ : std::vector<OpenFinding>{};
    }

private:
    Scheduler& scheduler_;
    Notices& notices_;
    std::string report_program_, outbox_;
    std::string made_of_; ///< run id of the certificate that was made last
    std::vector<OpenFinding> unanswered_;
};

} // namespace axiscal
