// What the service manager hears, against sd_notify(3) and sd_watchdog_enabled(3) of systemd 252.
#include "drivers/loop/service_manager.hpp"

#include "tests/support/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace axiscal::service_manager_test {
namespace {

/// As the service manager sets it for a unit; gone with the test.
class Variable {
public:
    Variable(const char* name, const std::string& value)
        : name_{name} {
        ::setenv(name, value.c_str(), 1);
    }
    ~Variable() { ::unsetenv(name_); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

private:
    const char* name_;
};

/// Its socket, bound to a path, or to an abstract name where `place` begins with a NUL.
class Manager {
public:
    explicit Manager(const std::string& place) {
        sockaddr_un address{AF_UNIX, {}};
        std::memcpy(address.sun_path, place.data(), place.size());
        const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + place.size());
        EXPECT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&address), size), 0);
    }
    ~Manager() { ::close(socket_); }
    Manager(const Manager&) = delete;
    Manager& operator=(const Manager&) = delete;
    /// One datagram; empty where none has come.
    [[nodiscard]] std::string heard() const {
        std::array<char, 256> words{};
        const auto count = ::recv(socket_, words.data(), words.size(), MSG_DONTWAIT);
        return count > 0 ? std::string{words.data(), static_cast<std::size_t>(count)} : "";
    }

private:
    int socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
};

TEST(ServiceManager, HearsEachWordAsADatagramOfItsOwn) {
    const testing::ScratchFolder folder;
    const Manager manager{folder.file("notify")};
    const Variable socket{"NOTIFY_SOCKET", folder.file("notify")};
    tell_service_manager("READY=1");
    tell_service_manager("WATCHDOG=1");
    EXPECT_EQ(manager.heard(), "READY=1");
    EXPECT_EQ(manager.heard(), "WATCHDOG=1");
}

TEST(ServiceManager, IsHeardOnAnAbstractSocketThatIsWrittenWithAnAt) {
    const std::string name = "axiscal-test-" + std::to_string(::getpid());
    const Manager manager{std::string(1, '\0') + name};
    const Variable socket{"NOTIFY_SOCKET", "@" + name};
    tell_service_manager("STOPPING=1");
    EXPECT_EQ(manager.heard(), "STOPPING=1");
}

TEST(ServiceManager, IsNotMissedWhereNobodyListensOrTheNameIsNone) {
    ::unsetenv("NOTIFY_SOCKET");
    tell_service_manager("READY=1");
    const std::array names{std::string{}, std::string{"/nowhere/notify"}, std::string{"notify"},
                           "/" + std::string(107, 'x')};
    for (const std::string& name : names) {
        const Variable socket{"NOTIFY_SOCKET", name};
        tell_service_manager("READY=1"); // neither ends the process nor waits
    }
}

TEST(ServiceManager, WatchesForAsLongAsItSays) {
    const Variable limit{"WATCHDOG_USEC", "10000000"};
    EXPECT_EQ(watchdog_limit(), std::chrono::seconds{10});
    const Variable process{"WATCHDOG_PID", std::to_string(::getpid())};
    EXPECT_EQ(watchdog_limit(), std::chrono::seconds{10});
}

TEST(ServiceManager, WatchesNobodyUnlessItSaysSoOfThisProcess) {
    ::unsetenv("WATCHDOG_USEC");
    EXPECT_EQ(watchdog_limit(), std::nullopt);
    for (const char* const text : {"", "0", "-1", "10 s", "18446744073709551615"}) {
        const Variable limit{"WATCHDOG_USEC", text};
        EXPECT_EQ(watchdog_limit(), std::nullopt) << text;
    }
    const Variable limit{"WATCHDOG_USEC", "10000000"};
    const Variable parent{"WATCHDOG_PID", std::to_string(::getppid())};
    EXPECT_EQ(watchdog_limit(), std::nullopt);
}

} // namespace
} // namespace axiscal::service_manager_test
