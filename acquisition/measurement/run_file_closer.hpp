#pragma once
// Closes run files, and waits for whoever reads them; goes on with one after the disk failed.

#include "analysis/quantity/result.hpp"
#include "analysis/quantity/time.hpp"
#include "drivers/loop/scheduler.hpp"

#include <optional>
#include <string>

namespace axiscal {

class Journal;
class Notices;
struct RunFileContents;

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

    /// The same without waiting: at a start, and after an order about a closed run, nobody waits
    /// for a reader. wait_for_readers() does what is left.
    /// @param run_id  of the file, for the log
    /// @errors as Journal::close, but for Fault::busy.
    Task<Result<void>> close_for_now(std::string run_id, bool complete, std::string reason);
    /// A closed run has its certificate once it is one file: its bytes are what the certificate
    /// names. Returns when those in `folder` are, or when the daemon ends.
    Task<void> wait_for_readers(std::string folder);
    /// Why no file may grow in `folder`, if so. The error is Fault::not_durable.
    Task<std::optional<Error>> trouble_in(std::string folder);

    /// Why a file is not closed yet: a record on its way to the disk, or a reader.
    /// @returns Fault::busy
    [[nodiscard]] tl::unexpected<Error> not_closed_yet() const;

    /// The disk takes records again, and the journal has the file open again: for how long it took
    /// none is the first that is written.
    /// @param since  when that was seen
    /// @returns what the file holds, read and verified. @errors as Journal::flush and ::contents.
    Task<Result<RunFileContents>> written_again(std::string path, MonotonicTime since);

private:
    Scheduler& scheduler_;
    Journal& journal_;
    Notices& notices_;
    const bool& stopping_;
    std::string reader_; ///< who reads the file that is being closed, in words
};

/// What failed on the disk that carries `folder`, and what to do, without the fault's own sentence.
std::string disk_text(const Error& error, const std::string& folder);

/// For whoever waits for the end of a test whose file could not be closed; the station closes it
/// later.
/// @param why  of RunFileCloser::close. @returns Fault::not_durable
tl::unexpected<Error> file_not_closed(const Error& why, const std::string& folder);

} // namespace axiscal
