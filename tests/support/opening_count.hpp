#pragma once
// How often the files of a folder are opened, by whomever: the kernel counts (inotify). Tests only.

#include <array>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <sys/inotify.h>
#include <unistd.h>

namespace axiscal::testing {

class OpeningCount {
public:
    explicit OpeningCount(const std::string& folder)
        : events_{::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)} {
        if (events_ < 0 || ::inotify_add_watch(events_, folder.c_str(), what) < 0)
            throw std::runtime_error("no inotify");
    }
    ~OpeningCount() { ::close(events_); }
    OpeningCount(const OpeningCount&) = delete;
    OpeningCount& operator=(const OpeningCount&) = delete;

    /// By name, since the last call; the kernel's queue holds 16384.
    std::map<std::string, int> take() {
        std::map<std::string, int> counts;
        alignas(inotify_event) std::array<char, 65536> bytes{};
        for (;;) {
            const ssize_t length = ::read(events_, bytes.data(), bytes.size());
            if (length <= 0) return counts;
            for (ssize_t place = 0; place < length;) {
                const auto* event = reinterpret_cast<const inotify_event*>(
                    &bytes.at(static_cast<std::size_t>(place)));
                if ((event->mask & IN_Q_OVERFLOW) != 0) throw std::runtime_error("too many");
                if ((event->mask & IN_OPEN) != 0 && event->len > 0) ++counts[event->name];
                place += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
            }
        }
    }

private:
    /// The kernel tells two openings in a row as one, unless something else comes between.
    static constexpr std::uint32_t what = IN_OPEN | IN_CLOSE;
    int events_;
};

} // namespace axiscal::testing
