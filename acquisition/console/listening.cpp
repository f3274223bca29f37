#include "acquisition/console/listening.hpp"

#include <cerrno>
#include <grp.h>
#include <optional>
#include <sys/stat.h>
#include <unistd.h>
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

/// 0660 from the first moment. Removes what a killed daemon left at this path; a running one is
/// refused by its lock.
Result<void> bind_socket(asio::local::stream_protocol::acceptor& local, const std::string& path) {
    boost::system::error_code error;
    ::unlink(path.c_str());
    local.open({}, error);
    const mode_t before = ::umask(0117);
    if (!error) local.bind(path, error);
    ::umask(before);
    if (!error) local.listen(16, error);
    if (!error) return {};
    return fail(Fault::io,
                "cannot listen on " + path +
                    "; does its folder exist and may this user write there?",
                error);
}

} // namespace

Result<void> listen(asio::local::stream_protocol::acceptor& local, const ConsoleConfig& config) {
    if (config.socket_path.empty()) return {};
    AXISCAL_TRY(const gid_t wanted, group_of_socket(config));
    AXISCAL_CHECK(bind_socket(local, config.socket_path));
    if (give_to_group(config.socket_path, wanted)) return {};
    const std::error_code refused{errno, std::generic_category()};
    ::unlink(config.socket_path.c_str());
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
    if (error)
        return fail(Fault::io,
                    "cannot listen on " + config.host + ":" + std::to_string(config.port) +
                        "; another program may hold the port (ss -ltnp)",
                    error);
    config.port = tcp.local_endpoint().port();
    return {};
}

} // namespace axiscal
