#include "drivers/wire/arrival.hpp"

#include "drivers/loop/deadline.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/use_awaitable.hpp>

#include <filesystem>
#include <sys/inotify.h>

namespace axiscal {
namespace {

namespace fs = std::filesystem;

/// A plug makes a burst of nodes, and a folder may be a busy one: looked at ten times a second.
constexpr Duration burst = std::chrono::milliseconds{100};
constexpr const char* usb_nodes = "/dev/bus/usb";

bool is_usb(const LinkSettings& settings) {
    return settings.kind == LinkSettings::Kind::usb || settings.kind == LinkSettings::Kind::hid;
}

/// A dangling link counts as there: its end may appear in any folder.
bool is_there(const LinkSettings& settings) {
    if (is_usb(settings)) return choose_usb(settings.usb, list_usb()).has_value();
    std::error_code error;
    return fs::exists(fs::symlink_status(settings.path, error));
}

/// The folder itself, or the nearest above it that there is.
fs::path nearest(fs::path folder) {
    std::error_code error;
    while (!fs::is_directory(folder, error) && folder.has_relative_path())
        folder = folder.parent_path();
    return folder;
}

/// Where something appears first when the device comes.
std::vector<fs::path> folders_for(const LinkSettings& settings) {
    if (!is_usb(settings)) return {nearest(fs::path{settings.path}.parent_path())};
    std::vector<fs::path> folders{nearest(usb_nodes)};
    std::error_code error;
    for (fs::directory_iterator bus{usb_nodes, error}, end; !error && bus != end;
         bus.increment(error))
        if (bus->is_directory(error)) folders.push_back(bus->path());
    return folders;
}

/// Tells of new entries in some folders, and of their end.
class FolderWatch {
public:
    FolderWatch(const boost::asio::any_io_executor& loop, const std::vector<fs::path>& folders)
        : events_{loop} {
        const int inotify = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
        if (inotify < 0) return;
        boost::system::error_code error;
        events_.assign(inotify, error);
        stands_ = !error;
        constexpr std::uint32_t what =
            IN_CREATE | IN_MOVED_TO | IN_DELETE_SELF | IN_MOVE_SELF | IN_ONLYDIR;
        for (const fs::path& folder : folders)
            stands_ = stands_ && ::inotify_add_watch(inotify, folder.c_str(), what) >= 0;
    }
    [[nodiscard]] bool stands() const { return stands_; }
    Task<bool> something_new() {
        const auto [error] =
            co_await events_.async_wait(boost::asio::posix::stream_descriptor::wait_read,
                                        boost::asio::as_tuple(boost::asio::use_awaitable));
        co_return !error;
    }

private:
    boost::asio::posix::stream_descriptor events_;
    bool stands_ = false;
};

} // namespace

Task<Arrival> await_arrival(Scheduler& scheduler, LinkSettings settings, MonotonicTime latest) {
    if (!is_usb(settings) && settings.kind != LinkSettings::Kind::serial)
        co_return Arrival::cannot_tell;
    if (is_there(settings)) co_return Arrival::cannot_tell;
    for (;;) {
        // Watched first and looked at then: nothing comes between.
        FolderWatch watch{scheduler.executor(), folders_for(settings)};
        if (is_there(settings)) co_return Arrival::came;
        if (!watch.stands()) co_return Arrival::cannot_tell;
        const auto heard = co_await before(scheduler, watch.something_new(), latest);
        if (!heard) co_return Arrival::not_yet;
        if (!*heard) co_return Arrival::cannot_tell;
        co_await scheduler.sleep_for(burst);
    }
}

} // namespace axiscal
