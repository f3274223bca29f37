#include "tools/axiscal/conformance/kit.hpp"

#include "config/measure.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fnmatch.h>
#include <fstream>
#include <iterator>
#include <utility>

namespace axiscal {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> stated_folders() {
    std::vector<std::string> folders;
    const char* const stated =
        std::getenv("AXISCAL_CONFORMANCE_PATH"); // NOLINT(concurrency-mt-unsafe)
    std::string_view rest = stated ? stated : "";
    while (!rest.empty()) {
        const auto folder = rest.substr(0, rest.find(':'));
        rest.remove_prefix(std::min(rest.size(), folder.size() + 1));
        if (!folder.empty()) folders.emplace_back(folder);
    }
    return folders;
}

std::vector<std::string> folders_around_program() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    if (error) return {};
    fs::path above = program.parent_path();
    std::vector<std::string> folders{
        (above.parent_path() / "share" / "axiscal" / "conformance").string()};
    while (above.has_relative_path()) {
        above = above.parent_path();
        folders.push_back((above / "tests" / "reference" / "conformance").string());
    }
    return folders;
}

using File = std::pair<std::string, fs::path>; ///< id and place

Result<std::vector<File>> files_in(const std::string& folder) {
    std::vector<File> files;
    std::error_code error;
    for (fs::directory_iterator entry{folder, error}, end; !error && entry != end;
         entry.increment(error))
        if (entry->path().extension() == ".json")
            files.emplace_back(entry->path().stem().string(), entry->path());
    if (error) return fail(Fault::io, "cannot read the folder " + folder, error);
    if (files.empty()) return fail(Fault::io, "there is no case in " + folder);
    std::ranges::sort(files);
    return files;
}

bool fits(const std::string& pattern, const std::string& id) {
    return ::fnmatch(pattern.c_str(), id.c_str(), 0) == 0;
}

Result<void> check_words(const std::vector<std::string>& only, const std::vector<File>& files) {
    for (const std::string& word : only) {
        if (std::ranges::any_of(files, [&](const File& file) { return fits(word, file.first); }))
            continue;
        std::vector<std::string> known;
        known.reserve(files.size());
        for (const File& file : files)
            known.push_back(file.first);
        const std::string near = nearest_word(word, known);
        return fail(Fault::not_found, "no case is called '" + word + "'" +
                                          (near.empty() ? "" : "; did you mean '" + near + "'?"));
    }
    return {};
}

void read_into(Kit& kit, const File& file) {
    std::ifstream stream{file.second, std::ios::binary};
    std::error_code error;
    if (!stream || fs::is_directory(file.second, error)) {
        kit.complaints.push_back(file.second.string() + ": cannot be read");
        kit.unreadable = true;
        return;
    }
    const std::string text{std::istreambuf_iterator<char>{stream}, {}};
    auto one = read_conformance_case(text, file.first);
    if (one)
        kit.cases.push_back(*std::move(one));
    else
        kit.complaints.push_back(file.second.string() + ": " + one.error().field + ": " +
                                 one.error().detail);
}

} // namespace

Result<std::string> find_conformance_folder(const std::string& stated) {
    if (!stated.empty()) return stated;
    std::vector<std::string> places = stated_folders();
    std::ranges::move(folders_around_program(), std::back_inserter(places));
    std::string list;
    for (const std::string& place : places) {
        std::error_code missing;
        if (fs::is_directory(place, missing)) return place;
        list += "\n  " + place;
    }
    return fail(Fault::not_found, "no folder of cases; name one by --cases. Looked at:" + list);
}

Result<Kit> read_kit(const std::string& folder, const std::vector<std::string>& only) {
    AXISCAL_TRY(const std::vector<File> files, files_in(folder));
    AXISCAL_CHECK(check_words(only, files));
    Kit kit;
    for (const File& file : files) {
        const auto wanted = [&](const std::string& word) { return fits(word, file.first); };
        if (only.empty() || std::ranges::any_of(only, wanted)) read_into(kit, file);
    }
    return kit;
}

} // namespace axiscal
