#pragma once
// A test that a person may add to, while it is open and after it was closed.

#include "acquisition/live/station_interface.hpp"
#include "analysis/quantity/result.hpp"
#include "drivers/loop/scheduler.hpp"

namespace axiscal {

/// Loop-bound. Neither while it is being closed, nor two of its tasks at once. After a failure
/// order_is_lost() may say that the disk has to be waited for.
class Revisable {
public:
    virtual ~Revisable() = default;
    virtual Task<Result<RetakeAnswer>> retake(RevisionRequest request) = 0;
    virtual Task<Result<int>> exclude(RevisionRequest request) = 0;
    virtual Task<Result<void>> answer_finding(AnswerRequest request) = 0; ///< once it is closed
    /// An order could not be written: the file may hold it all the same.
    [[nodiscard]] virtual bool order_is_lost() const = 0;
    /// @errors Fault::not_durable while it is not known what became of one.
    [[nodiscard]] virtual Result<void> order_is_known() const = 0;
};

} // namespace axiscal
