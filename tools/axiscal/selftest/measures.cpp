// The measurements themselves: one disk, one timer, one pseudo terminal.
#include "acquisition/runfile/durable_file.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "drivers/wire/serial_link.hpp"
#include "tools/axiscal/selftest/selftest.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fcntl.h>
#include <filesystem>
#include <termios.h>
#include <thread>
#include <unistd.h>

namespace axiscal {
namespace {

using Clock = std::chrono::steady_clock;

double us_since(Clock::time_point begin) {
    return std::chrono::duration<double, std::micro>(Clock::now() - begin).count();
}

/// Removes the trial file and what SQLite keeps beside it.
class TrialFile {
public:
    explicit TrialFile(const std::string& folder)
        : path_{folder + "/selftest-" + std::to_string(::getpid()) + std::string{run_file_ending}} {
    }
    TrialFile(const TrialFile&) = delete;
    TrialFile& operator=(const TrialFile&) = delete;
    ~TrialFile() {
        std::error_code ignored; // a leftover is swept by nobody, but the figures are told
        for (const char* ending : {"", "-wal", "-shm", "-journal", ".new", ".new-journal"})
            std::filesystem::remove(path_ + ending, ignored);
    }
    [[nodiscard]] const std::string& path() const { return path_; }

private:
    std::string path_;
};

/// Both ends of a pseudo terminal, set to bytes as they are.
Result<std::array<int, 2>> open_pty() {
    const int master = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (master < 0 || ::grantpt(master) != 0 || ::unlockpt(master) != 0)
        return fail_io("cannot open", "/dev/ptmx");
    std::array<char, 64> name{};
    if (::ptsname_r(master, name.data(), name.size()) != 0)
        return fail_io("cannot name", "/dev/ptmx");
    const int slave = ::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (slave < 0) return fail_io("cannot open", name.data());
    termios raw{};
    ::tcgetattr(slave, &raw);
    ::cfmakeraw(&raw);
    ::tcsetattr(slave, TCSANOW, &raw);
    return std::array<int, 2>{master, slave};
}

} // namespace

Result<Delays> measure_commit(const std::string& folder, int count) {
    const TrialFile trial{folder};
    RunRecord header;
    header.run_id = "selftest";
    AXISCAL_TRY(auto writer, RunFileWriter::create(trial.path(), header));
    std::vector<double> took_us;
    took_us.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        const auto begin = Clock::now();
        AXISCAL_CHECK(writer.append_note("selftest", MonotonicTime{}, 0));
        took_us.push_back(us_since(begin));
    }
    return delays_of(std::move(took_us));
}

Result<Delays> measure_timer(int count) {
    constexpr long step_ns = 1'000'000, second_ns = 1'000'000'000;
    std::vector<double> late_us;
    late_us.reserve(static_cast<std::size_t>(count));
    timespec due{};
    if (::clock_gettime(CLOCK_MONOTONIC, &due) != 0)
        return fail_io("cannot read", "CLOCK_MONOTONIC");
    for (int i = 0; i < count; ++i) {
        due.tv_nsec += step_ns;
        if (due.tv_nsec >= second_ns) due.tv_nsec -= second_ns, ++due.tv_sec;
        while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr) == EINTR) {
        }
        timespec now{};
        ::clock_gettime(CLOCK_MONOTONIC, &now);
        late_us.push_back(1e6 * static_cast<double>(now.tv_sec - due.tv_sec) +
                          1e-3 * static_cast<double>(now.tv_nsec - due.tv_nsec));
        due = now; // one late wake-up is not counted again by those after it
    }
    return delays_of(std::move(late_us));
}

Result<Delays> measure_serial(int count) {
    AXISCAL_TRY(const auto ends, open_pty());
    const FileHandle master{ends[0]}, slave{ends[1]};
    // The byte on its way through the kernel orders both threads; the language does not know that.
    std::vector<std::atomic<Clock::rep>> sent(static_cast<std::size_t>(count));
    std::vector<double> took_us;
    took_us.reserve(sent.size());
    std::thread sender{[&] {
        for (auto& at : sent) {
            std::this_thread::sleep_for(std::chrono::milliseconds{1});
            at = Clock::now().time_since_epoch().count();
            if (::write(master.get(), "x", 1) != 1) return;
        }
    }};
    char byte = 0;
    for (const auto& at : sent) {
        if (::read(slave.get(), &byte, 1) != 1) break;
        took_us.push_back(us_since(Clock::time_point{Clock::duration{at.load()}}));
    }
    sender.join();
    return delays_of(std::move(took_us));
}

SerialPort look_at_port(const std::string& path) {
    SerialPort port;
    port.path = path;
    if (::access(path.c_str(), R_OK | W_OK) != 0)
        port.refused = std::generic_category().message(errno);
    port.latency_timer_ms = usb_latency_timer_ms(path);
    return port;
}

} // namespace axiscal
