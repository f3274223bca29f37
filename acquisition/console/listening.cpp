#include "acquisition/console/listening.hpp"

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <grp.h>
#include <optional>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace axiscal {
namespace {

namespace asio = boost::asio;

/// Empty when there is no such group.
std::optional<gid_t> group_id(const std::string& name) {
    std::vector<char> texts(1024);
    group entry{};
    group* found = nullptr;
    while (::getgrnam_r(name.c_str(), &entry, texts.data(), texts.size(), &found) == ERANGE)
        texts.resize(2 * texts.size());
    return found != nullptr ? std::optional{entry.gr_gid} : std::nullopt;
}

/// The service's own where the station file names none.
Result<gid_t> group_of_socket(const ConsoleConfig& config) {
    if (config.group.empty()) return ::getegid();
    if (const auto known = group_id(config.group)) return *known;
    return fail(Fault::io,
                "[console] group: this PC has no group '" + config.group +
                    "', which is to own the socket " + config.socket_path +
                    "; make it (sudo systemd-sysusers axiscal.conf), or name another one");
}

/// What has it already is left alone: the unit of systemd forbids chown(2).
bool give_to_group(const std::string& path, gid_t wanted) {
    struct stat now {};
    if (::stat(path.c_str(), &now) == 0 && now.st_gid == wanted) return true;
    return ::chown(path.c_str(), static_cast<uid_t>(-1), wanted) == 0;
}

/// Held while a socket is bound: of two daemons that begin at once, one sees the other's.
class FolderLock {
public:
    explicit FolderLock(const std::filesystem::path& socket)
        : file_{::open(socket.has_parent_path() ? socket.parent_path().c_str() : ".",
                       O_RDONLY | O_DIRECTORY | O_CLOEXEC)} {
        if (file_ >= 0) ::flock(file_, LOCK_EX); // where it cannot be had, bind(2) tells why
    }
    ~FolderLock() {
        if (file_ >= 0) ::close(file_);
    }
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

private:
    int file_;
};

/// Whether somebody listens there. A socket whose owner has died refuses.
bool is_served(const std::string& path) {
    asio::io_context loop;
    asio::local::stream_protocol::socket visitor{loop};
    boost::system::error_code error;
    visitor.open({}, error);
    visitor.non_blocking(true, error); // a full queue is an answer, too
    visitor.connect(path, error);
    return error != asio::error::connection_refused && error != asio::error::not_found;
}

/// Takes away what a killed daemon left, and nothing else.
Result<void> clear_path(const std::string& path) {
    struct stat found {};
    if (::lstat(path.c_str(), &found) != 0) return {}; // bind(2) tells what else is wrong
    if (!S_ISSOCK(found.st_mode))
        return fail(Fault::refused,
                    path + " is there and is no socket: it stays as it is; move it away, or name "
                           "another path as [console] socket");
    if (is_served(path))
        return fail(Fault::busy,
                    "another axiscald answers at " + path +
                        "; stop it first, or give this station a [console] socket of its own");
    if (::unlink(path.c_str()) == 0) return {};
    return fail(Fault::io, "cannot remove " + path + ", which an ended axiscald left",
                {errno, std::generic_category()});
}

/// 0660 from the first moment.
Result<SocketFile> bind_socket(asio::local::stream_protocol::acceptor& local,
                               const std::string& path) {
    const FolderLock alone{path};
    AXISCAL_CHECK(clear_path(path));
    boost::system::error_code error;
    local.open({}, error);
    const mode_t before = ::umask(0117);
    if (!error) local.bind(path, error);
    ::umask(before);
    if (!error) {
        SocketFile made{path};
        local.listen(16, error);
        if (!error) return made;
    }
    return fail(Fault::io,
                "cannot listen on " + path +
                    "; does its folder exist and may this user write there?",
                error);
}

} // namespace

SocketFile::SocketFile(std::string path)
    : path_{std::move(path)} {
    struct stat made {};
    if (::lstat(path_.c_str(), &made) != 0) path_.clear(); // gone already
    device_ = made.st_dev;
    inode_ = made.st_ino;
}

SocketFile::SocketFile(SocketFile&& other) noexcept
    : path_{std::exchange(other.path_, {})}
    , device_{other.device_}
    , inode_{other.inode_} {}

SocketFile& SocketFile::operator=(SocketFile&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(device_, other.device_);
    std::swap(inode_, other.inode_);
    return *this;
}

SocketFile::~SocketFile() {
    struct stat now {};
    if (path_.empty() || ::lstat(path_.c_str(), &now) != 0) return;
    if (now.st_dev == device_ && now.st_ino == inode_) ::unlink(path_.c_str());
}

Result<SocketFile> listen(asio::local::stream_protocol::acceptor& local,
                          const ConsoleConfig& config) {
    if (config.socket_path.empty()) return SocketFile{};
    AXISCAL_TRY(const gid_t wanted, group_of_socket(config));
    AXISCAL_TRY(SocketFile made, bind_socket(local, config.socket_path));
    if (give_to_group(config.socket_path, wanted)) return made;
    const std::error_code refused{errno, std::generic_category()};
    return fail(Fault::io,
                "[console] group: cannot give " + config.socket_path + " to group '" +
                    config.group + "'; the user who runs axiscald must be a member of it",
                refused);
}

Result<void> listen(asio::ip::tcp::acceptor& tcp, ConsoleConfig& config) {
    if (config.port == 0) return {};
    boost::system::error_code error;
    const auto address = asio::ip::make_address(config.host, error);
    if (error)
        return fail(Fault::bad_configuration,
                    "console.host '" + config.host + "' is not an address");
    const asio::ip::tcp::endpoint end{
        address, static_cast<std::uint16_t>(config.port < 0 ? 0 : config.port)};
    tcp.open(end.protocol(), error);
    if (!error) tcp.set_option(asio::socket_base::reuse_address{true}, error);
    if (!error) tcp.bind(end, error);
    if (!error) tcp.listen(16, error);
    if (error) {
        boost::system::error_code ignored;
        tcp.close(ignored);
        return fail(Fault::io,
                    "cannot listen on " + config.host + ":" + std::to_string(config.port) +
                        "; another program may hold the port (ss -ltnp), or the address is not of "
                        "this PC (ip address)",
                    error);
    }
    config.port = tcp.local_endpoint().port();
    return {};
}

} // namespace axiscal
