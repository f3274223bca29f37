#include "drivers/loop/service_manager.hpp"

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace axiscal {
namespace {

/// Empty where it is not set.
std::string_view environment(const char* name) {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): no other thread changes the environment
    const char* const value = std::getenv(name);
    return value == nullptr ? std::string_view{} : value;
}

/// Empty unless all of it is a number.
std::optional<std::uint64_t> number_in(std::string_view text) {
    std::uint64_t number = 0;
    const char* const end = text.data() + text.size();
    const auto [next, error] = std::from_chars(text.data(), end, number);
    return error == std::errc{} && next == end ? std::optional{number} : std::nullopt;
}

} // namespace

void tell_service_manager(std::string_view words) {
    const std::string_view place = environment("NOTIFY_SOCKET");
    sockaddr_un address{AF_UNIX, {}};
    const bool named = place.starts_with('/') || place.starts_with('@');
    if (!named || place.size() >= sizeof address.sun_path) return;
    std::memcpy(address.sun_path, place.data(), place.size());
    if (place.front() == '@') address.sun_path[0] = '\0';
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + place.size());
    const int manager = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (manager < 0) return;
    ::sendto(manager, words.data(), words.size(), MSG_NOSIGNAL,
             reinterpret_cast<const sockaddr*>(&address), size);
    ::close(manager);
}

std::optional<Duration> watchdog_limit() {
    const auto process = environment("WATCHDOG_PID");
    if (!process.empty() && number_in(process) != static_cast<std::uint64_t>(::getpid()))
        return std::nullopt;
    const auto limit_us = number_in(environment("WATCHDOG_USEC"));
    constexpr std::uint64_t longest_us = 1'000'000'000'000'000; // 30 years, and no overflow
    if (!limit_us || *limit_us == 0 || *limit_us > longest_us) return std::nullopt;
    return std::chrono::microseconds{*limit_us};
}

} // namespace axiscal
