#include "tools/axiscal/imported_certificate.hpp"

#include "acquisition/runfile/run_file.hpp"
#include "tools/axiscal/complaint.hpp"
#include "tools/axiscal/exit_code.hpp"
#include "tools/axiscal/imports/imported_run.hpp"
#include "tools/axiscal/offline_commands.hpp"

#include <chrono>
#include <filesystem>
#include <iostream>
#include <utility>

namespace axiscal {
namespace {

/// This command's clock begins with it.
ClockTie tie_of_now() {
    const auto utc = std::chrono::system_clock::now().time_since_epoch();
    return {MonotonicTime{}, std::chrono::nanoseconds{utc}.count(), MonotonicTime{}};
}

/// The datum and every point in one transaction.
Result<void> fill_imported_run(RunFileWriter writer, const RunBatch& all, const RunRecord& run) {
    AXISCAL_CHECK(writer.write(all));
    return writer.close(true, run.closing_reason, run.closed);
}

/// What could not be written whole goes: its name would be taken, and a station would resume it.
void remove_unfinished(const std::string& path) {
    std::error_code ignored;
    for (const char* more : {"", "-wal", "-shm", "-journal", ".new", ".new-journal"})
        std::filesystem::remove(path + more, ignored);
}

Result<void> write_imported_run(const std::string& path, RunRecord run) {
    RunBatch all;
    all.datum = std::exchange(run.datums, {}).front();
    all.imported = std::exchange(run.points, {});
    auto writer = RunFileWriter::create(path, run);
    if (!writer && writer.error().fault == Fault::refused) // of somebody else
        return tl::unexpected<Error>(writer.error());
    auto written = writer ? fill_imported_run(*std::move(writer), all, run)
                          : Result<void>{tl::unexpected<Error>(writer.error())};
    if (!written && written.error().fault != Fault::busy) remove_unfinished(path);
    return written;
}

/// No machine waits for this disk.
Error as_io(Error error) {
    if (error.fault == Fault::not_durable) error.fault = Fault::io;
    return error;
}

} // namespace

int certify_import(const ImportedFile& file,
                   ImportedReadings from,
                   const std::string& folder,
                   bool json) {
    if (file.only_backward)
        return complain(Error{Fault::bad_case,
                              "all its runs go backward: a certificate speaks of forward ones",
                              {},
                              "file"});
    for (const std::string& remark : file.remarks)
        from.remark += (from.remark.empty() ? "" : " ") + remark;
    auto run = imported_run(file.document, std::move(from), tie_of_now());
    if (!run) return complain(run.error());
    std::error_code ignored; // writing tells
    std::filesystem::create_directories(folder, ignored);
    const std::string path = folder + "/" + run->run_id + std::string{run_file_ending};
    if (const auto written = write_imported_run(path, *std::move(run)); !written)
        return complain(as_io(written.error()));
    const int code = command_export(path, folder, json);
    if (code != exit_ok)
        std::cerr << "The readings lie in " << path << "; 'axiscal export " << path << " --out "
                  << folder << "' makes the certificate\n";
    return code;
}

} // namespace axiscal
