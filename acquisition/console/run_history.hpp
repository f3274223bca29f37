#pragma once
// The station's stored runs as people look for them: run files, and the certificates that lie
// beside them. Reads alone. Blocking calls, for one thread at a time.

#include "acquisition/console/certificate_facts.hpp"
#include "acquisition/console/run_papers.hpp"
#include "acquisition/console/runs_query.hpp"
#include "acquisition/runfile/run_file.hpp"

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

enum class StoredStatus : std::uint8_t { open, complete, incomplete, unreadable };
std::string_view name_of(StoredStatus status);
enum class PaperState : std::uint8_t { none, waiting, published };
std::string_view name_of(PaperState state);

/// One row of the list.
struct StoredRun {
    std::string id; ///< name of its file without ".axiscal"
    StoredStatus status = StoredStatus::unreadable;
    std::optional<RunSummary> summary; ///< nothing of one that is open, or could not be read
    std::string sentence;              ///< what keeps it from being read, why it is incomplete
    PaperState paper = PaperState::none;
    std::string paper_sentence; ///< why there is none, and how it is made; empty: it is there
    std::optional<CertificateFacts> facts; ///< of the certificate that belongs to it as it stands
    std::string folder;                    ///< of the certificate; not for clients
};

struct RunsPage {
    std::vector<StoredRun> runs; ///< newest first, by the instant in the name
    std::string next;            ///< `before` of the next question; empty: nothing is left
    std::size_t passed_over = 0; ///< files whose name is none that a run is given
};

/// A row with everything that is there of it.
struct RunWithPapers {
    StoredRun run;
    std::vector<PaperFile> papers;
    std::string certificate; ///< text of certificate.json, valid JSON; empty: none that counts
};

struct PaperBytes {
    std::string type;      ///< content type
    std::string file_name; ///< for who keeps it: "demo-20261121T100000Z-X.pdf"
    std::string bytes;
};

/// Which runs this daemon has open: their files are not opened. Closing one would have to wait for
/// a reader, and what they hold the status tells.
using OpenRuns = std::set<std::string, std::less<>>;

class RunHistory {
public:
    explicit RunHistory(std::string state_directory);

    /// At most 200 files that are not known yet are opened for one page; a page may then be short,
    /// or empty, and still have a `next`. @param stop  looked at between files: ends the page there
    RunsPage
    page(const RunsAsked& asked, const OpenRuns& open, const std::function<bool()>& stop = {});
    /// @errors Fault::not_found where no stored run is called so.
    Result<RunWithPapers> one(const std::string& id, const OpenRuns& open);
    /// @errors Fault::not_found for another name, or where there is no such paper, with the way to
    /// it; Fault::refused for one beyond 32 MiB; Fault::io.
    Result<PaperBytes> paper(const RunNamed& named, const OpenRuns& open);

private:
    /// What was read of a file and of its certificate, as long as their stamps hold.
    struct Known {
        FileStamp file, certificate;
        std::string folder; ///< that `certificate` is the stamp of
        StoredRun run;
    };
    struct Names {
        std::set<std::string> all;    ///< of the folder
        std::vector<std::string> ids; ///< newest first
        std::size_t passed_over = 0;
    };
    [[nodiscard]] Names names() const;
    StoredRun look(const std::string& id, const Names& names, const OpenRuns& open);
    StoredRun read_file(const std::string& id, Known& known);
    StoredRun read(const std::string& id, Known& known);
    void forget_some();

    std::string state_directory_, runs_;
    std::map<std::string, Known> known_; ///< by id
    std::size_t opened_ = 0;             ///< files, since the page began
};

/// Whether a row holds the text: id, date (2026-01-02), kind, axis, machine, serial, state, number
/// of the certificate. Blanks part words that must all be there.
bool holds_text(const StoredRun& run, std::string_view text);

} // namespace axiscal
