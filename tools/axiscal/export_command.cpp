// `axiscal export`: the report program draws, this one says where the papers lie.
#include "acquisition/documents/evaluate.hpp"
#include "acquisition/measurement/certificate_writer.hpp"
#include "acquisition/runfile/durable_file.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "config/json_text.hpp"
#include "tools/axiscal/complaint.hpp"
#include "tools/axiscal/exit_code.hpp"
#include "tools/axiscal/exports/readings_text.hpp"
#include "tools/axiscal/offline_commands.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <iostream>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

int failed_to_start(const std::string& program, int reason) {
    std::cerr << "cannot start " << program << " (" << std::generic_category().message(reason)
              << ")\n";
    return exit_failed;
}

std::string read_to_end(int descriptor) {
    std::string text;
    std::array<char, 4096> piece{};
    for (;;) {
        const ssize_t count = ::read(descriptor, piece.data(), piece.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return text;
        text.append(piece.data(), static_cast<std::size_t>(count));
    }
}

/// Runs to the end; its complaints go where ours go. @returns its exit code
int run_program(std::vector<std::string> words, std::string& said) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return failed_to_start(words.front(), errno);
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (std::string& word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    pid_t child = -1;
    const int failed =
        ::posix_spawnp(&child, words.front().c_str(), &actions, nullptr, arguments.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    if (failed == 0) said = read_to_end(ends[0]);
    ::close(ends[0]);
    if (failed != 0) return failed_to_start(words.front(), failed);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : static_cast<int>(exit_failed);
}

/// What the report program says: a row of the verdict where there are limits, then the folder and
/// the files in it. One object of both; null where it is something else.
Json papers_of(const std::string& said) {
    std::istringstream lines{said};
    Json papers, verdict;
    for (std::string line; std::getline(lines, line);) {
        Json object = Json::parse(line, nullptr, false);
        if (!object.is_object()) return {};
        (object.contains("entry") ? papers : verdict) = std::move(object);
    }
    if (!papers.is_object()) return {};
    if (verdict.is_object()) papers["verdict"] = std::move(verdict);
    return papers;
}

void print_papers(const Json& papers) {
    if (papers.contains("verdict"))
        std::cout << "Verdict on " << papers["verdict"].value("parameter", "") << ": "
                  << papers["verdict"].value("verdict", "") << "\n";
    std::cout << "The certificate lies in " << papers["entry"].get<std::string>() << ":\n";
    for (const auto& [key, path] : papers.items())
        if (key != "entry" && path.is_string())
            std::cout << "  " << std::filesystem::path(path.get<std::string>()).filename().string()
                      << "\n";
}

} // namespace

namespace {

Result<std::string> exported_text(const Certificate& certificate, const std::string& format) {
    if (format == "csv") return readings_csv(certificate);
    return laser10_text(certificate);
}

/// The readings alone, for another program. @returns the file.
Result<std::string>
export_readings(const std::string& file, const std::string& folder, const std::string& format) {
    AXISCAL_TRY(const TestResult result, evaluate_run_file(file));
    const auto* certificate = std::get_if<Certificate>(&result);
    if (certificate == nullptr)
        return fail(Fault::refused,
                    file + " is no positioning test: it has no readings at targets");
    AXISCAL_TRY(const std::string text, exported_text(*certificate, format));
    AXISCAL_TRY(const RunSummary run, summarize_run_file(file));
    std::error_code ignored; // writing tells
    std::filesystem::create_directories(folder, ignored);
    std::string path = folder + "/" + certificate_name(run) + "." + format;
    AXISCAL_CHECK(replace_synced(path, text));
    return path;
}

} // namespace

int command_export_readings(const std::string& file,
                            const std::string& folder,
                            const std::string& format,
                            bool json) {
    const auto path = export_readings(file, folder, format);
    if (!path) return complain(path.error());
    std::cout << (json ? json_text(Json{{"readings", *path}}) + "\n"
                       : "The readings lie in " + *path + "\n")
              << std::flush;
    return exit_ok;
}

int command_export(const std::string& file, const std::string& out_directory, bool json) {
    const std::string program = sibling_program("axiscal-report");
    std::string said;
    const int code = run_program({program, file, "--to", out_directory}, said);
    if (code != exit_ok) return code;
    const Json papers = papers_of(said);
    if (!papers.is_object()) {
        std::cerr << program << " said nothing of its papers: " << said << "\n";
        return exit_failed;
    }
    if (json)
        std::cout << json_text(papers) << "\n" << std::flush;
    else
        print_papers(papers);
    return exit_ok;
}

} // namespace axiscal
