#include "acquisition/publish/publisher_report.hpp"

#include "config/json_text.hpp"
#include <nlohmann/json.hpp>

#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <fstream>

namespace axiscal {
namespace {

namespace fs = std::filesystem;

constexpr mode_t file_mode = 0640;

std::string beside(const std::string& outbox, const std::string& name) {
    auto path = fs::path{outbox}.lexically_normal();
    if (!path.has_filename()) path = path.parent_path();
    return (path.parent_path() / name).string();
}

} // namespace

Result<void> write_report(const std::string& outbox, const PublisherReport& report) {
    const nlohmann::ordered_json document{{"format", "axiscal.publisher/1"},
                                          {"destination", report.destination},
                                          {"state", report.state},
                                          {"reason", report.reason},
                                          {"since_utc", report.since_utc}};
    const auto path = beside(outbox, "publisher.json"), unfinished = path + ".part";
    {
        std::ofstream file{unfinished};
        file << json_text(document) << '\n';
        if (!file.flush()) return fail_io("cannot write", unfinished);
    }
    if (std::rename(unfinished.c_str(), path.c_str()) != 0) return fail_io("cannot replace", path);
    return {};
}

Result<FileHandle> lock_outbox(const std::string& outbox) {
    const auto path = beside(outbox, "publisher.lock");
    std::error_code error;
    fs::create_directories(fs::path{path}.parent_path(), error);
    FileHandle file{::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, file_mode)};
    if (!file) return fail_io("cannot open", path);
    struct flock whole {};
    whole.l_type = F_WRLCK;
    whole.l_whence = SEEK_SET;
    if (::fcntl(file.get(), F_OFD_SETLK, &whole) == 0) return file;
    if (errno == EACCES || errno == EAGAIN)
        return fail(Fault::busy, "another axiscal-publish works on " + outbox);
    return fail_io("cannot lock", path);
}

} // namespace axiscal
