#pragma once
// Closes run files, and waits for whoever reads them.

#include "analysis/quantity/result.hpp"
#include "drivers/loop/scheduler.hpp"

#include <string>

namespace axiscal {

class Journal;
class Notices;

/// Loop-bound. One run file is open at a time.
class RunFileCloser {
public:
    /// @param stopping  the daemon is about to end: nobody is waited for any more
    RunFileCloser(Scheduler& scheduler, Journal& journal, Notices& notices, const bool& stopping);

    /// The file that the journal has open. Whoever reads it holds up the last step, by which it
    /// becomes one file: that is no fault of the disk, and is waited for. The closing row is
    /// durable from the first attempt on.
    /// @errors as Journal::close; Fault::busy only when the daemon ends meanwhile.
    Task<Result<void>> close(bool complete, std::string reason);

    /// Why a file is not closed yet: a record on its way to the disk, or a reader.
    /// @returns Fault::busy
    [[nodiscard]] tl::unexpected<Error> not_closed_yet() const;

private:
    Scheduler& scheduler_;
    Journal& journal_;
    Notices& notices_;
    const bool& stopping_;
    std::string reader_; ///< who reads the file that is being closed, in words
};

/// What failed on the disk that carries `folder`, and what to do, without the fault's own sentence.
std::string disk_text(const Error& error, const std::string& folder);

} // namespace axiscal
