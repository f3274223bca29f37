#include "acquisition/console/run_history.hpp"

#include "acquisition/console/stored_certificate.hpp"
#include "acquisition/runfile/run_store.hpp"
#include "analysis/quantity/time.hpp"
#include "analysis/quantity/valid_text.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

namespace axiscal {
namespace {

constexpr std::size_t most_opened = 200;    // for one page
constexpr std::size_t most_known = 5000;    // rows of a kilobyte or two
constexpr std::size_t most_names = 200'000; // of the folder of runs
constexpr std::size_t most_certificate = std::size_t{8} << 20U, most_paper = std::size_t{32} << 20U;

/// Newest first; a name without an instant stands behind all others.
bool is_newer(const std::string& one, const std::string& other) {
    return std::pair{instant_of_name(one), one} > std::pair{instant_of_name(other), other};
}

StoredRun row_of_open(const std::string& id, std::string sentence) {
    StoredRun run;
    run.id = id;
    run.status = StoredStatus::open;
    run.sentence = std::move(sentence);
    run.paper_sentence = "A run gets its certificate when it is closed.";
    return run;
}

/// Without the folder: an answer tells no path that the status does not tell.
std::string without_path(std::string words, const std::string& path) {
    const std::string name = std::filesystem::path{path}.filename().string();
    for (std::size_t at = words.find(path); at != std::string::npos; at = words.find(path, at))
        words.replace(at, path.size(), name);
    return words;
}

/// A file from elsewhere may hold megabytes where a name is expected.
void bound_texts(RunSummary& summary) {
    constexpr std::size_t longest = 300;
    for (std::string* text : {&summary.axis, &summary.machine, &summary.machine_serial,
                              &summary.machine_state, &summary.closing_reason})
        *text = valid_text(std::string_view{*text}.substr(0, longest));
}

StoredStatus status_of_summary(const RunSummary& summary) {
    if (!summary.closed) return StoredStatus::open;
    return summary.complete ? StoredStatus::complete : StoredStatus::incomplete;
}

char lower_letter(char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

std::string lower_text(std::string_view text) {
    std::string lower{text};
    std::ranges::transform(lower, lower.begin(), lower_letter);
    return lower;
}

std::string searched_in(const StoredRun& run) {
    std::string all = run.id;
    const auto add = [&all](std::string_view text) { all.append("\n").append(text); };
    add(name_of(run.status));
    if (run.summary) {
        add(name_of(run.summary->kind));
        add(iso8601_utc(run.summary->opened_utc_ns));
        for (const std::string* text : {&run.summary->axis, &run.summary->machine,
                                        &run.summary->machine_serial, &run.summary->machine_state})
            add(*text);
    }
    if (run.facts) add(run.facts->number);
    return lower_text(all);
}

struct PaperType {
    std::string_view ending, type;
};
constexpr std::array paper_types{
    PaperType{".pdf", "application/pdf"}, PaperType{".json", "application/json; charset=utf-8"},
    PaperType{".csv", "text/csv; charset=utf-8"}, PaperType{".axiscal", "application/vnd.sqlite3"}};

const PaperType& paper_type_of(std::string_view name) {
    const auto* found = std::ranges::find_if(
        paper_types, [&](const PaperType& one) { return name.ends_with(one.ending); });
    return found == paper_types.end() ? paper_types.back() : *found;
}

} // namespace

bool holds_text(const StoredRun& run, std::string_view text) {
    const std::string all = searched_in(run), words = lower_text(text);
    for (std::string_view rest = words; !rest.empty();) {
        const std::string_view word = rest.substr(0, rest.find(' '));
        rest.remove_prefix(std::min(word.size() + 1, rest.size()));
        if (all.find(word) == std::string::npos) return false;
    }
    return true;
}

RunHistory::RunHistory(std::string state_directory)
    : state_directory_{std::move(state_directory)}
    , runs_{state_directory_ + "/runs"} {}

RunHistory::Names RunHistory::names() const {
    Names names;
    std::error_code error;
    for (std::filesystem::directory_iterator at{runs_, error}, end; !error && at != end;
         at.increment(error)) {
        std::string name = at->path().filename().string();
        if (name.ends_with(run_file_ending) && !name.starts_with('.')) {
            std::string id = name.substr(0, name.size() - run_file_ending.size());
            if (is_run_name(id) && names.ids.size() < most_names)
                names.ids.push_back(std::move(id));
            else
                ++names.passed_over;
        }
        names.all.insert(std::move(name));
    }
    std::ranges::sort(names.ids, is_newer);
    return names;
}

/// A file that is being written has another beside it, which a closed one has not.
StoredRun RunHistory::look(const std::string& id, const Names& names, const OpenRuns& open) {
    if (open.contains(id)) return row_of_open(id, "It is going on: the screen Run shows it.");
    const std::string file = id + std::string{run_file_ending};
    for (const char* ending : {"-wal", "-shm", "-journal"})
        if (names.all.contains(file + ending))
            return row_of_open(id,
                               "It is being written, or was interrupted: the station puts it in "
                               "order when it starts.");
    Known& known = known_[id];
    StoredRun run = read(id, known);
    known.run = run;
    return run;
}

/// Of the run file alone, unless that is known.
StoredRun RunHistory::read_file(const std::string& id, Known& known) {
    const std::string path = runs_ + "/" + id + std::string{run_file_ending};
    const FileStamp file = stamp_of(path);
    if (known.file == file && file.is_there()) return known.run;
    ++opened_;
    known = {};
    StoredRun run;
    run.id = id;
    auto summary = summarize_run_file(path);
    if (!summary) { // no stamp is kept: another program may have held it for a moment
        run.sentence = without_path(describe(summary.error()), path);
        run.paper_sentence = why_no_paper(run);
        return run;
    }
    known.file = file;
    bound_texts(*summary);
    run.status = status_of_summary(*summary);
    if (run.status == StoredStatus::incomplete) run.sentence = summary->closing_reason;
    run.summary = *std::move(summary);
    return run;
}

StoredRun RunHistory::read(const std::string& id, Known& known) {
    StoredRun run = read_file(id, known);
    if (!run.summary) return run;
    const auto folders = run.summary->closed
                             ? paper_folders(state_directory_, certificate_name(*run.summary))
                             : std::vector<PaperFolder>{};
    const std::string first = folders.empty() ? std::string{} : folders.front().path;
    const FileStamp certificate =
        first.empty() ? FileStamp{} : stamp_of(first + "/certificate.json");
    const bool same = known.folder == first && known.certificate == certificate;
    if (same && (run.facts || !run.paper_sentence.empty())) return run;
    ++opened_;
    known.folder = first;
    known.certificate = certificate;
    run.facts.reset();
    run.folder.clear();
    run.paper = PaperState::none;
    take_certificate(run, folders, most_certificate);
    return run;
}

void RunHistory::forget_some() {
    if (known_.size() > most_known) known_.clear();
}

RunsPage
RunHistory::page(const RunsAsked& asked, const OpenRuns& open, const std::function<bool()>& stop) {
    opened_ = 0;
    forget_some();
    const Names all = names();
    RunsPage page;
    page.passed_over = all.passed_over;
    std::string last;
    for (const std::string& id : all.ids) {
        if (!asked.before.empty() && !is_newer(asked.before, id)) continue;
        const bool enough = page.runs.size() >= asked.limit || opened_ >= most_opened;
        if (enough || (stop && stop())) {
            page.next = last;
            break;
        }
        StoredRun run = look(id, all, open);
        last = id;
        if (holds_text(run, asked.text)) page.runs.push_back(std::move(run));
    }
    return page;
}

Result<RunWithPapers> RunHistory::one(const std::string& id, const OpenRuns& open) {
    forget_some();
    const Names all = names();
    if (std::ranges::find(all.ids, id) == all.ids.end())
        return fail(Fault::not_found,
                    "no stored run is called " + id + "; GET /v1/runs lists those that are there");
    RunWithPapers found;
    found.run = look(id, all, open);
    if (!found.run.facts) return found;
    found.papers = papers_in(found.run.folder, id);
    AXISCAL_TRY(found.certificate,
                read_whole(found.run.folder + "/certificate.json", most_certificate));
    // It may have been replaced since its facts were read.
    AXISCAL_TRY(const CertificateFacts facts, facts_of_certificate(found.certificate));
    if (facts.result_digest != found.run.facts->result_digest)
        return fail(Fault::busy, "its certificate is being replaced: ask again");
    return found;
}

Result<PaperBytes> RunHistory::paper(const RunNamed& named, const OpenRuns& open) {
    AXISCAL_TRY(const RunWithPapers found, one(named.id, open));
    const auto wanted = std::ranges::find(found.papers, named.paper, &PaperFile::name);
    if (wanted == found.papers.end()) {
        const std::string& why = found.run.paper_sentence;
        return fail(Fault::not_found, "run " + named.id + " has no paper of this name. " + why);
    }
    const PaperType& type = paper_type_of(wanted->name);
    auto bytes = read_whole(found.run.folder + "/" + wanted->name, most_paper);
    if (!bytes)
        return fail(bytes.error().fault,
                    wanted->name + ": " + bytes.error().detail + "; it lies on the station's PC",
                    bytes.error().cause);
    return PaperBytes{std::string{type.type}, named.id + std::string{type.ending},
                      *std::move(bytes)};
}

} // namespace axiscal
