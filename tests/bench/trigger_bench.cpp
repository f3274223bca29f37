// A trigger from the CNC's request to the `done` that it reads: the mean of the last 1000 samples,
// the point durable in the run file with all of them. Held against an echo of as many bytes that
// first makes one block of the same disk durable.
#include "acquisition/capture/capture.hpp"
#include "acquisition/journal/journal.hpp"
#include "drivers/loop/asio_scheduler.hpp"
#include "drivers/loop/spawn.hpp"
#include "drivers/trigger/modbus_tcp_port.hpp"
#include "drivers/trigger/single_register_map.hpp"
#include "tests/bench/loopback.hpp"
#include "tests/bench/row.hpp"
#include "tests/unit/runfile/random_run.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>

#include <fcntl.h>
#include <filesystem>
#include <random>

namespace axiscal::bench {
namespace {

constexpr int triggers = 100, samples = 1000;
constexpr auto sample_period = std::chrono::microseconds{1000};
constexpr std::size_t written_size = 12, read_size = 11; // replies to FC 6 and to FC 4 of one word
constexpr std::size_t disk_block = 4096;
constexpr double laser_step_m = 632.991e-9 / 512; // 64 of them: 80 nm of noise about 0.5 mm
const testing::Bytes how_far = testing::framed(2, {4, 0, 0, 0, 1});

/// On a real disk, as the tests' folders are not.
class DiskFolder {
public:
    DiskFolder() {
        if (::mkdtemp(path_.data()) == nullptr) std::abort();
    }
    ~DiskFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    DiskFolder(const DiskFolder&) = delete;
    DiskFolder& operator=(const DiskFolder&) = delete;
    [[nodiscard]] std::string file(const std::string& name) const { return path_ + "/" + name; }

private:
    std::string path_ = "/var/tmp/axiscal-bench-XXXXXX";
};

testing::Bytes request_of(std::uint16_t sequence) {
    return testing::framed(1, {6, 0, 0, static_cast<std::uint8_t>(sequence >> 8U),
                               static_cast<std::uint8_t>(sequence & 0xFFU)});
}

/// What the station does with a request, without its judgement of the place.
class Answering final : public TriggerSink {
public:
    Answering(Scheduler& scheduler, Journal& journal, TriggerPort& port)
        : scheduler_{scheduler}
        , journal_{journal}
        , port_{port} {
        std::mt19937 noise{1};
        for (int i = 0; i < samples; ++i)
            history_.push({0, began_ + i * sample_period + std::chrono::nanoseconds{noise() % 3},
                           (405'000 + static_cast<int>(noise() % 64)) * laser_step_m,
                           static_cast<std::uint64_t>(i), 0});
        config_.minimum_samples = samples;
    }
    void on_trigger(const TriggerEvent& event) override { spawn(scheduler_, answer(event)); }
    void on_cnc_silent(bool) override {}
    void on_port_note(Fault, std::string) override {}

private:
    Task<void> answer(TriggerEvent event) {
        const MonotonicTime end = began_ + (samples - 1) * sample_period;
        const auto window = history_.between(began_, end);
        const StillWindow still{began_, end, statistics_of(summary_of(window))};
        auto capture = make_capture(history_, still, std::nullopt, config_);
        if (!capture) std::abort();
        PointRecord point;
        point.step = step_++;
        point.sequence = event.sequence;
        point.planned.step = point.step;
        point.triggered_at = event.at, point.window_begin = began_, point.window_end = end;
        point.reading = capture->mean, point.spread = capture->spread, point.n = capture->n;
        point.datum_id = "d";
        point.samples = std::move(capture->samples);
        const auto receipt = co_await journal_.commit(std::move(point), capture->synchronisation);
        if (!receipt) std::abort();
        port_.acknowledge(*receipt);
    }

    Scheduler& scheduler_;
    Journal& journal_;
    TriggerPort& port_;
    SampleHistory history_;
    CaptureConfig config_;
    MonotonicTime began_ = monotonic_from_ns(1'000'000'000);
    int step_ = 0;
};

/// A port, a journal on a thread of its own and a run file, to the end of the program.
struct Door {
    DiskFolder scratch;
    boost::asio::io_context loop;
    AsioScheduler scheduler{loop};
    Journal journal{scheduler};
    ModbusTcpPort port;
    Answering station{scheduler, journal, port};

    explicit Door(const TriggerConfig& config)
        : port{std::make_unique<SingleRegisterMap>(), config, ClientPatience{}} {
        spawn(scheduler, open());
        boost::asio::co_spawn(loop, port.run(TriggerContext{&scheduler, &station}),
                              boost::asio::detached);
        while (!opened || port.bound_port() == 0)
            loop.run_one();
        port.publish_armed();
        thread = std::thread{[this] { loop.run(); }};
    }
    ~Door() {
        loop.stop();
        thread.join();
    }
    Door(const Door&) = delete;
    Door& operator=(const Door&) = delete;
    Task<void> open() {
        std::string path = scratch.file("run.axiscal");
        RunRecord header = testing::RandomRun{1}.header();
        const auto done = co_await journal.open(std::move(path), std::move(header));
        if (!done) std::abort();
        opened = true;
    }
    bool opened = false;
    std::thread thread;
};

int start_station() {
    TriggerConfig config;
    config.port = 0;
    static Door door{config};
    return door.port.bound_port();
}

Work triggering() {
    return [client = std::shared_ptr<Client>{}, sequence = std::uint16_t{0}]() mutable {
        if (!client) client = std::make_shared<Client>(start_station());
        for (int i = 0; i < triggers; ++i) {
            sequence = next_sequence(sequence);
            client->ask(request_of(sequence), written_size);
            for (bool done = false; !done;) {
                const auto reply = client->ask(how_far, read_size);
                done = (reply[9] << 8U | reply[10]) == sequence;
            }
        }
    };
}

/// Both exchanges, the first answered when a block of the disk is durable.
void durable_echo(int listener) {
    static const DiskFolder scratch; // removed when the program ends
    const int file = ::open(scratch.file("log").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    const int connection = ::accept(listener, nullptr, nullptr);
    send_at_once(connection);
    std::array<char, 256> in{}, out{};
    const std::array<char, disk_block> block{};
    for (ssize_t got = 0; (got = ::recv(connection, in.data(), in.size(), 0)) > 0;) {
        const bool request = in[7] == 6; // the function
        if (request && (::write(file, block.data(), block.size()) < 0 || ::fdatasync(file) != 0))
            std::abort();
        ::send(connection, out.data(), request ? written_size : read_size, MSG_NOSIGNAL);
    }
}

Work echoing() {
    return [client = std::shared_ptr<Client>{}]() mutable {
        if (!client) client = std::make_shared<Client>(start(durable_echo));
        for (int i = 0; i < triggers; ++i) {
            client->ask(request_of(1), written_size);
            client->ask(how_far, read_size);
        }
    };
}

[[maybe_unused]] const bool added = add(Row{"trigger, mean of 1000, durable, done read, 100 times",
                                            triggering(), echoing(), 2.2, 0, "echo + fdatasync"});

} // namespace
} // namespace axiscal::bench
