// axiscal-report RUN.axiscal --outbox DIR | --to DIR
// axiscal-report CASE.json --to DIR
// Short-lived, started by the daemon when a run is closed (and by `axiscal export`): draws the
// certificate and stages it; of a circular case, too. stdout: with limits a line of JSON with the
// verdict and the figure that it rests on; then one with the paths, and what the readings say of a
// wrong set-up as "setup", a sentence each, and as "to_answer" what of it nobody answered.
// stderr: one sentence. Exit 0 done, 1 file or program, 2 usage, 3 the run file or the case is
// refused or the run is incomplete.

#include "acquisition/documents/conformity_json.hpp"
#include "acquisition/documents/evaluate.hpp"
#include "acquisition/documents/pdf/certificate_files.hpp"
#include "acquisition/events/event_folder.hpp"
#include "acquisition/publish/outbox.hpp"
#include "acquisition/runfile/durable_file.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "acquisition/runfile/signing_key.hpp"
#include "analysis/setup/setup_words.hpp"
#include "config/standard_streams.hpp"
#include "config/version.hpp"
#include "tools/axiscal/circular_case_certificate.hpp"
#include "tools/describe/describe.hpp"

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

namespace axiscal {
namespace {

constexpr int exit_ok = 0, exit_failed = 1, exit_usage = 2, exit_refused = 3;

struct Options {
    std::string run_file;
    std::string outbox;
    std::string to; ///< any folder; both get <run-id>/ in one rename
};

/// The folder that holds the outbox.
std::string state_of(const std::string& outbox) {
    const std::filesystem::path whole = std::filesystem::absolute(outbox);
    return (whole / "").lexically_normal().parent_path().parent_path().string();
}

/// The first evaluation is the station's own report, numbered and signed with what lies beside its
/// outbox; an export changes nothing.
Result<TestResult> evaluate(const Options& options) {
    if (!options.to.empty()) return evaluate_run_file(options.run_file);
    const std::string state = state_of(options.outbox);
    AXISCAL_TRY(const auto key, read_station_key(state, read_machine_id()));
    const Issue issue{key.get(), state};
    return evaluate_run_file(options.run_file, &issue);
}

std::string one_line(const nlohmann::ordered_json& object) {
    return object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// What is said of a result beside its paths.
struct Said {
    std::string parameter, word; ///< of the verdict: the figure that it rests on, "pass"
    std::string verdict;         ///< row of the figure that it rests on; empty: no limits
    std::vector<std::string> setup_findings; ///< a sentence each
    nlohmann::ordered_json to_answer;        ///< those that nobody answered, in parts; null: none
};

struct Staged {
    std::string entry;
    Said said;
};

std::string verdict_line_of(const TestResult& result) {
    const auto& conformity = conformity_of(result);
    const JudgedFigure* decisive = conformity ? conformity->decisive() : nullptr;
    return decisive ? one_line(verdict_row(*decisive, *conformity)) : std::string{};
}

std::vector<std::string> setup_findings_of(const TestResult& result) {
    std::vector<std::string> sentences;
    if (const auto* certificate = std::get_if<Certificate>(&result))
        for (const SetupFinding& found : certificate->setup_findings)
            sentences.push_back(sentence_of(found));
    return sentences;
}

nlohmann::ordered_json unanswered_of(const TestResult& result) {
    nlohmann::ordered_json rows;
    if (const auto* certificate = std::get_if<Certificate>(&result))
        for (const SetupFinding& found : certificate->setup_findings)
            if (found.answer.empty())
                rows.push_back({{"error", name_of(found.error)},
                                {"seen", found.seen},
                                {"probably", found.probably},
                                {"look_at", found.look_at}});
    return rows;
}

Said said_of(const TestResult& result) {
    Said said;
    if (const auto& conformity = conformity_of(result); conformity && conformity->decisive()) {
        said.parameter = conformity->decisive()->parameter;
        said.word = conformity->decisive()->verdict;
    }
    said.verdict = verdict_line_of(result);
    said.setup_findings = setup_findings_of(result);
    said.to_answer = unanswered_of(result);
    return said;
}

Result<Said> draw(const Options& options, const std::string& folder) {
    AXISCAL_TRY(const TestResult result, evaluate(options));
    AXISCAL_CHECK(write_certificate_files(result, options.run_file, folder));
    return said_of(result);
}

bool is_refusal(Fault fault) {
    switch (fault) {
    case Fault::io:
    case Fault::internal:
    case Fault::not_durable: return false;
    default: return true;
    }
}

/// A station that starts tries again what failed for the disk: it finds the folder by which it
/// knows that. What was refused would be refused again.
void clear_away(const Options& options, const Error& why, const std::string& name) {
    const std::string& folder = options.to.empty() ? options.outbox : options.to;
    const auto emptied = begin_entry(folder, name);
    if (!emptied || (options.to.empty() && !is_refusal(why.fault))) return;
    std::error_code ignored; // the first error is the one to tell
    std::filesystem::remove(*emptied, ignored);
}

/// Before the entry has its name: a certificate that a power cut took back is made again, and so is
/// this, under the same id. A disk that fails here fails the entry next, which is told.
void tell_complete(const Options& options, const RunSummary& run, const Said& said) {
    if (!options.to.empty()) return;
    StationEvent event;
    event.when_utc = iso8601_utc(
        std::chrono::nanoseconds{std::chrono::system_clock::now().time_since_epoch()}.count());
    event.run_id = run.run_id;
    event.test = run.kind;
    event.certificate = certificate_name(run);
    event.parameter = said.parameter;
    event.verdict = said.word;
    static_cast<void>(lay_event(state_of(options.outbox), event));
}

/// The entry appears in the outbox only with all its content. Its folder is there before the result
/// is stored: a station that finds it after a power cut knows that this was not finished.
Result<Staged> stage(const Options& options) {
    AXISCAL_TRY(const RunSummary run, summarize_run_file(options.run_file));
    const std::string& folder = options.to.empty() ? options.outbox : options.to;
    const std::string name = certificate_name(run);
    AXISCAL_TRY(const FileHandle held, hold_outbox(folder));
    AXISCAL_TRY(const std::string temporary, begin_entry(folder, name));
    AXISCAL_CHECK(sync_folder(folder));
    auto drawn = draw(options, temporary);
    if (!drawn) {
        clear_away(options, drawn.error(), name);
        return tl::unexpected<Error>(std::move(drawn).error());
    }
    tell_complete(options, run, *drawn);
    AXISCAL_TRY(std::string entry, finish_entry(folder, name));
    return Staged{std::move(entry), *std::move(drawn)};
}

/// The same for a case: into any folder, never into the outbox, for no run stands behind it.
Result<Staged> stage_case(const Options& options) {
    if (options.to.empty())
        return fail(Fault::refused, "is no run file: a case goes into a folder by --to");
    AXISCAL_TRY(CircularCertificate certificate, circular_certificate_of_case(options.run_file));
    const std::string name = certificate.measured.run.run_id;
    AXISCAL_TRY(const FileHandle held, hold_outbox(options.to));
    AXISCAL_TRY(const std::string temporary, begin_entry(options.to, name));
    const TestResult result{std::move(certificate)};
    if (auto written = write_certificate_files(result, options.run_file, temporary); !written) {
        clear_away(options, written.error(), name);
        return tl::unexpected<Error>(std::move(written).error());
    }
    AXISCAL_TRY(std::string entry, finish_entry(options.to, name));
    return Staged{std::move(entry), said_of(result)};
}

bool is_run_file(const std::string& path) {
    constexpr std::string_view magic{"SQLite format 3\0", 16};
    std::ifstream file{path, std::ios::binary};
    std::string head(magic.size(), '\0');
    return file.read(head.data(), static_cast<std::streamsize>(head.size())) && head == magic;
}

/// What a person calls a case ends in .json; all else is taken for a run file, whose reader says
/// what is wrong with it.
bool is_case(const std::string& path) {
    return !is_run_file(path) && std::filesystem::path(path).extension() == ".json";
}

std::string paths_line(const Staged& staged, const std::string& run_file, bool of_case) {
    const std::string& entry = staged.entry;
    nlohmann::ordered_json line;
    line["entry"] = entry;
    line["json"] = entry + "/" + certificate_json_name;
    line["csv"] = entry + "/" + certificate_csv_name;
    line["pdf"] = entry + "/" + certificate_pdf_name;
    line[of_case ? "case" : "run_file"] =
        entry + "/" + std::filesystem::path(run_file).filename().string();
    if (!staged.said.setup_findings.empty()) line["setup"] = staged.said.setup_findings;
    if (!staged.said.to_answer.is_null()) line["to_answer"] = staged.said.to_answer;
    return one_line(line);
}

int report(const Options& options) {
    const bool of_case = is_case(options.run_file);
    const auto staged = of_case ? stage_case(options) : stage(options);
    if (!staged) {
        const Error& why = staged.error();
        std::cerr << options.run_file << ": " << (why.field.empty() ? "" : why.field + ": ")
                  << describe(why) << "\n";
        return is_refusal(why.fault) ? exit_refused : exit_failed;
    }
    if (!staged->said.verdict.empty()) std::cout << staged->said.verdict << "\n";
    std::cout << paths_line(*staged, options.run_file, of_case) << std::endl;
    return exit_ok;
}

int run(int argc, char** argv) {
    CLI::App app{
        "axiscal-report: certificate.json, .csv and .pdf of a closed run or of a circular case",
        "axiscal-report"};
    Options options;
    app.add_option("RUN", options.run_file, "run file, or the JSON of a circular case")->required();
    auto* places = app.add_option_group("place", "where the folder <run-id> is made");
    places->add_option("--outbox", options.outbox, "the station's outbox");
    places->add_option("--to", options.to, "any folder");
    places->require_option(1);
    app.set_version_flag("--version", software_version());
    describe_on_request(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? exit_ok : exit_usage;
    }
    return report(options);
}

} // namespace
} // namespace axiscal

int main(int argc, char** argv) {
    axiscal::open_standard_streams();
    axiscal::StandardOutput output;
    int code = axiscal::exit_failed;
    try {
        code = axiscal::run(argc, argv);
    } catch (const std::exception& error) {
        std::cerr << "axiscal-report: " << error.what() << "\n";
    }
    return output.end("axiscal-report", code);
}
