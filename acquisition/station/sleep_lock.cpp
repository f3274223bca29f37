#include "acquisition/station/sleep_lock.hpp"

#include "drivers/loop/spawn.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/use_awaitable.hpp>

#include <array>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace axiscal {
namespace {

namespace asio = boost::asio;
using Descriptor = asio::posix::stream_descriptor;

constexpr std::string_view given = "held\n";
constexpr std::size_t most_words = 4096; // of a program that only complains

/// The shell says that the lock is there: it is started only then. `cat` ends with its input, that
/// is when we close it, or end, however we do.
/// The lid too: by logind's default closing it suspends in spite of a lock on sleep alone.
std::vector<std::string> words_for(const std::string& program) {
    return {program,
            "--what=sleep:handle-lid-switch",
            "--who=axiscald",
            "--why=a calibration run is open",
            "--mode=block",
            "sh",
            "-c",
            "echo held; exec cat >/dev/null"};
}

} // namespace

SleepLock::SleepLock(Scheduler& scheduler, std::string program)
    : scheduler_{scheduler}
    , program_{std::move(program)}
    , slept_{scheduler.asleep()} {}

SleepLock::~SleepLock() {
    if (input_ >= 0) ::close(input_);
}

void SleepLock::want(bool wanted) {
    if (wanted == std::exchange(wanted_, wanted)) return;
    if (wanted)
        ask();
    else
        let_go();
}

Duration SleepLock::slept_in_spite_of_it() {
    constexpr Duration noticeable = std::chrono::milliseconds{500};
    const Duration slept = scheduler_.asleep() - slept_;
    if (slept < noticeable) return Duration{};
    slept_ += slept;
    return slept;
}

void SleepLock::try_out() {
    ask();
}

void SleepLock::let_go() {
    if (held_ && input_ >= 0) ::close(std::exchange(input_, -1));
}

void SleepLock::ask() {
    if (asking_ || program_.empty()) return; // one that ends just now looks whether it is wanted
    refusal_.clear();
    const Result<ChildProcess> child = start_child(words_for(program_), ChildInput::pipe);
    if (!child) {
        refusal_ = describe(child.error());
        return;
    }
    asking_ = true;
    input_ = child->input;
    spawn(scheduler_, hold_while_wanted(*child));
}

Task<void> SleepLock::hold_while_wanted(ChildProcess child) {
    Descriptor output{scheduler_.executor(), child.output};
    Descriptor process{scheduler_.executor(), child.process};
    std::string said;
    std::array<char, 256> piece{};
    while (!said.ends_with(given) && said.size() < most_words) {
        const auto [error, size] = co_await output.async_read_some(
            asio::buffer(piece), asio::as_tuple(asio::use_awaitable));
        if (error) break;
        said.append(piece.data(), size);
    }
    held_ = said.ends_with(given);
    if (!held_ || !wanted_)
        if (input_ >= 0) ::close(std::exchange(input_, -1));
    co_await process.async_wait(Descriptor::wait_read, asio::as_tuple(asio::use_awaitable));
    ::waitpid(child.pid, nullptr, 0); // it has ended: this does not wait
    const bool taken_away = held_ && input_ >= 0;
    if (!held_) refusal_ = program_ + ": " + last_line_of(said);
    if (taken_away) refusal_ = program_ + " was ended";
    if (input_ >= 0) ::close(std::exchange(input_, -1));
    asking_ = held_ = false;
    if (wanted_ && refusal_.empty()) ask();
}

} // namespace axiscal
