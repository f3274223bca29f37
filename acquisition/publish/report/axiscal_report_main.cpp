// axiscal-report RUN.axiscal --outbox DIR | --to DIR
// Short-lived, started by the daemon when a run is closed (and by `axiscal export`): draws the
// certificate and stages it. stdout: one line of JSON with the paths; stderr: one sentence.
// Exit 0 done, 1 file or program, 2 usage, 3 the run file is refused or the run is incomplete.

#include "acquisition/publish/outbox.hpp"
#include "acquisition/publish/report/certificate_files.hpp"
#include "acquisition/publish/run_certificate.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
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

/// The entry appears in the outbox only with all its content.
Result<std::string> stage(const Certificate& certificate, const Options& options) {
    const std::string& folder = options.to.empty() ? options.outbox : options.to;
    AXISCAL_TRY(const std::string temporary, begin_entry(folder, certificate.run.run_id));
    if (auto written = write_certificate_files(certificate, options.run_file, temporary);
        !written) {
        std::error_code ignored; // the first error is the one to tell
        std::filesystem::remove_all(temporary, ignored);
        return tl::unexpected<Error>(std::move(written).error());
    }
    return finish_entry(folder, certificate.run.run_id);
}

std::string paths_line(const std::string& entry, const std::string& run_file) {
    nlohmann::ordered_json line;
    line["entry"] = entry;
    line["json"] = entry + "/" + certificate_json_name;
    line["csv"] = entry + "/" + certificate_csv_name;
    line["pdf"] = entry + "/" + certificate_pdf_name;
    line["run_file"] = entry + "/" + std::filesystem::path(run_file).filename().string();
    return line.dump();
}

bool is_refusal(Fault fault) {
    switch (fault) {
    case Fault::io:
    case Fault::internal:
    case Fault::not_durable: return false;
    default: return true;
    }
}

int report(const Options& options) {
    // Only the station's own report is the first evaluation; an export changes nothing.
    const Result<void> sealed = options.to.empty() ? seal_result(options.run_file) : Result<void>{};
    auto certificate =
        sealed ? certificate_of_run_file(options.run_file) : tl::unexpected<Error>(sealed.error());
    const auto entry =
        certificate.and_then([&](const Certificate& made) { return stage(made, options); });
    if (!entry) {
        std::cerr << options.run_file << ": " << describe(entry.error()) << "\n";
        return is_refusal(entry.error().fault) ? exit_refused : exit_failed;
    }
    std::cout << paths_line(*entry, options.run_file) << std::endl;
    return exit_ok;
}

int run(int argc, char** argv) {
    CLI::App app{"axiscal-report: certificate.json, .csv and .pdf of a closed run",
                 "axiscal-report"};
    Options options;
    app.add_option("RUN", options.run_file, "run file")->required();
    auto* places = app.add_option_group("place", "where the folder <run-id> is made");
    places->add_option("--outbox", options.outbox, "the station's outbox");
    places->add_option("--to", options.to, "any folder");
    places->require_option(1);
    app.set_version_flag("--version", AXISCAL_VERSION);
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
    try {
        return axiscal::run(argc, argv);
    } catch (const std::exception& error) {
        std::cerr << "axiscal-report: " << error.what() << "\n";
        return 1;
    }
}
