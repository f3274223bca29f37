// Source: CiA 301 V4.2: 7.3.2 (states), 7.5.2.1 (0x1000), .2 (0x1001), .19 (0x1017), .20 (0x1018),
// .37 and .38 (0x1800, 0x1A00).
#include "drivers/canopen/canopen_session.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace axiscal {
namespace {

constexpr Duration open_patience = std::chrono::seconds{2};
/// From the reset of its communication to the boot-up message; a node that sends none is asked all
/// the same.
constexpr Duration boot_patience = std::chrono::seconds{1};
constexpr std::uint32_t heartbeat_ms = 1000;
/// 2.5 heartbeats of one millisecond.
constexpr Duration patience_a_ms = std::chrono::microseconds{2500};
constexpr Duration send_patience = std::chrono::milliseconds{500};
/// Without PDOs: three periods, and never less than a turn of a busy computer.
constexpr Duration least_patience = std::chrono::seconds{1};
constexpr Duration shortest_look = std::chrono::milliseconds{20};
constexpr int most_pdos = 8;
constexpr std::uint32_t most_entries = 64; ///< of a mapping: single bits
constexpr std::uint32_t longest_id = 0x7FF;

constexpr ObjectKey device_type_key{0x1000, 0}, device_name_key{0x1008, 0}, software_key{0x100A, 0},
    heartbeat_key{0x1017, 0};
constexpr std::uint16_t identity_index = 0x1018, pdo_index = 0x1800, mapping_index = 0x1A00;

ObjectKey key_of(std::uint16_t base, int number, int sub) {
    return {static_cast<std::uint16_t>(base + number - 1), static_cast<std::uint8_t>(sub)};
}

std::string hexadecimal(std::uint32_t number) {
    char word[16];
    std::snprintf(word, sizeof word, "0x%X", number);
    return word;
}

} // namespace

CanOpenSession::CanOpenSession(CanOpenSetup setup, InstrumentCounters& counters)
    : setup_{std::move(setup)}
    , counters_{counters}
    , register_watch_{setup_.node} {}

void CanOpenSession::close() {
    node_.reset();
    link_.reset();
}

/// The number, or `otherwise` where the node has no such object.
Task<Result<std::uint32_t>> CanOpenSession::number_or(ObjectKey key, std::uint32_t otherwise) {
    auto value = co_await node_->read_number(key);
    if (!value && value.error().fault == Fault::refused) co_return otherwise;
    co_return value;
}

/// As printable ASCII.
Task<Result<std::string>> CanOpenSession::text_or_nothing(ObjectKey key) {
    const auto content = co_await node_->read(key);
    if (!content && content.error().fault == Fault::refused) co_return std::string{};
    if (!content) co_return tl::unexpected<Error>(content.error());
    std::string text;
    for (const std::byte byte : *content)
        if (std::to_integer<int>(byte) >= ' ' && std::to_integer<int>(byte) < 127)
            text += std::to_integer<char>(byte);
    co_return text;
}

Task<Result<void>> CanOpenSession::identify() {
    std::array<std::uint32_t, 4> words{}; // maker, product, revision, serial number
    for (std::size_t at = 0; at < words.size(); ++at) {
        const ObjectKey key{identity_index, static_cast<std::uint8_t>(at + 1)};
        AXISCAL_CO_TRY(words[at], co_await number_or(key, 0));
    }
    AXISCAL_CO_TRY(std::string model, co_await text_or_nothing(device_name_key));
    AXISCAL_CO_TRY(const std::string software, co_await text_or_nothing(software_key));
    if (model.empty()) model = "product " + hexadecimal(words[1]);
    const Identity who{"CiA vendor " + hexadecimal(words[0]), model, std::to_string(words[3]),
                       software.empty() ? "revision " + hexadecimal(words[2]) : software};
    context_.sink->identify(who);
    co_return Result<void>{};
}

/// Adds TPDO `number`, if the node has it and it is in use.
Task<Result<void>> CanOpenSession::read_layout(int number) {
    constexpr std::uint32_t not_valid = 1U << 31U;
    AXISCAL_CO_TRY(const std::uint32_t id,
                   co_await number_or(key_of(pdo_index, number, 1), not_valid));
    if ((id & not_valid) != 0 || (id & 0x1FFFFFFFU) > longest_id) co_return Result<void>{};
    AXISCAL_CO_TRY(const std::uint32_t entries,
                   co_await number_or(key_of(mapping_index, number, 0), 0));
    if (entries > most_entries)
        co_return fail(Fault::bad_frame, node_->name() + " maps " + std::to_string(entries) +
                                             " objects into TPDO" + std::to_string(number));
    std::vector<std::uint32_t> words(entries);
    for (std::uint32_t at = 0; at < entries; ++at) {
        const ObjectKey key = key_of(mapping_index, number, static_cast<int>(at + 1));
        AXISCAL_CO_TRY(words[at], co_await node_->read_number(key));
    }
    AXISCAL_CO_TRY(PdoLayout layout, pdo_layout(number, id & longest_id, words));
    if (!layout.entries.empty()) layouts_.push_back(std::move(layout));
    co_return Result<void>{};
}

Task<Result<void>> CanOpenSession::open(InstrumentContext context) {
    context_ = context;
    layouts_.clear();
    used_.clear();
    beats_ = in_error_ = operational_ = false;
    register_watch_ = RegisterWatch{setup_.node};
    guard_.end();
    bus_errors_ = 0;
    then_.reset();
    Scheduler& scheduler = *context.scheduler;
    AXISCAL_CO_TRY(link_,
                   co_await context.links->open_can(setup_.link, scheduler.now() + open_patience));
    node_ = std::make_unique<CanOpenNode>(*link_, scheduler, setup_.node, setup_.link.describe());
    const auto n = static_cast<std::uint32_t>(setup_.node);
    if (const auto heard = link_->hear({0x080 + n, 0x580 + n, 0x700 + n}); !heard) co_return heard;
    const auto reset = co_await node_->command(NmtCommand::reset_communication);
    if (!reset) co_return reset;
    const auto booted = co_await node_->boots_up(scheduler.now() + boot_patience);
    if (!booted) co_return tl::unexpected<Error>(booted.error());
    AXISCAL_CO_TRY(device_type_, co_await node_->read_number(device_type_key));
    if ((device_type_ & 0xFFFFU) != setup_.profile)
        co_return fail(Fault::bad_configuration, node_->name() + " is of CiA profile " +
                                                     std::to_string(device_type_ & 0xFFFFU) +
                                                     ", not " + std::to_string(setup_.profile) +
                                                     ": is the node number right?");
    const auto identified = co_await identify();
    if (!identified) co_return identified;
    for (int number = 1; number <= most_pdos; ++number) {
        const auto read = co_await read_layout(number);
        if (!read) co_return read;
    }
    co_return Result<void>{};
}

/// Sent by time. A node that cannot change its period is watched all the same.
Task<Result<void>> CanOpenSession::set_up(const PdoLayout& layout) {
    constexpr std::uint32_t by_time = 0xFE;
    const ObjectKey kind = key_of(pdo_index, layout.number, 2);
    AXISCAL_CO_TRY(const std::uint32_t transmission, co_await number_or(kind, by_time));
    if (transmission < by_time) {
        const auto changed = co_await node_->write_number(kind, by_time, 1);
        if (!changed) co_return changed;
    }
    const auto period_ms =
        static_cast<std::uint32_t>(setup_.sample_period / std::chrono::milliseconds{1});
    const ObjectKey timer = key_of(pdo_index, layout.number, 5);
    auto timed = co_await node_->write_number(timer, period_ms, 2);
    if (!timed && timed.error().fault == Fault::refused) co_return Result<void>{};
    co_return timed;
}

/// A node that refuses may have a heartbeat of its own that cannot be changed. Without any it is
/// guarded, and one that does not know guarding is watched by its PDOs alone.
Task<Result<void>> CanOpenSession::ask_for_heartbeat() {
    const auto asked = co_await node_->write_number(heartbeat_key, heartbeat_ms, 2);
    if (!asked && asked.error().fault != Fault::refused) co_return asked;
    std::uint32_t period_ms = heartbeat_ms;
    if (!asked) {
        AXISCAL_CO_TRY(period_ms, co_await number_or(heartbeat_key, 0));
    }
    beats_ = period_ms > 0;
    beat_patience_ = patience_a_ms * static_cast<std::int64_t>(period_ms);
    if (!beats_) guard_.begin(context_.scheduler->now());
    co_return Result<void>{};
}

/// Asks the guarded node when that is due.
Task<Result<void>> CanOpenSession::guard() {
    const MonotonicTime now = context_.scheduler->now();
    if (!guard_.asks(now)) co_return Result<void>{};
    const CanFrame question = guard_request(setup_.node);
    auto sent = co_await link_->send(question, now + send_patience);
    co_return sent;
}

/// A fault that no emergency told stands in the register all the same.
void CanOpenSession::judge_error_register(unsigned errors) {
    if (in_error_ || !tells_a_fault(errors)) return;
    in_error_ = true;
    context_.sink->note(Fault::signal_error, node_->name() +
                                                 " reports a fault in its error register, " +
                                                 hexadecimal(errors));
}

/// What the node told before nobody heard.
Task<Result<void>> CanOpenSession::read_error_register() {
    AXISCAL_CO_TRY(const std::uint32_t errors, co_await number_or(error_register_key, 0));
    judge_error_register(errors & 0xFFU);
    co_return Result<void>{};
}

/// Beside the PDOs, when that is due.
Task<Result<void>> CanOpenSession::ask_error_register() {
    const MonotonicTime now = context_.scheduler->now();
    const auto question = register_watch_.question(now);
    if (!question) co_return Result<void>{};
    auto sent = co_await link_->send(*question, now + send_patience);
    co_return sent;
}

Task<Result<void>> CanOpenSession::start(std::vector<std::size_t> used) {
    used_ = std::move(used);
    const auto n = static_cast<std::uint32_t>(setup_.node);
    std::vector<std::uint32_t> ids{0x080 + n, 0x580 + n, 0x700 + n};
    for (const std::size_t index : used_) {
        const auto done = co_await set_up(layouts_[index]);
        if (!done) co_return done;
        ids.push_back(layouts_[index].id);
    }
    const auto asked = co_await ask_for_heartbeat();
    if (!asked) co_return asked;
    const auto errors = co_await read_error_register();
    if (!errors) co_return errors;
    if (const auto heard = link_->hear(ids); !heard) co_return heard;
    last_beat_ = last_pdo_ = context_.scheduler->now();
    auto started = co_await node_->command(NmtCommand::start);
    co_return started;
}

Result<void> CanOpenSession::take_state(NodeState state, MonotonicTime at) {
    last_beat_ = at;
    // A beat may have been on its way before the node was started.
    operational_ |= state == NodeState::operational;
    if (state != NodeState::boot_up && (state == NodeState::operational || !operational_))
        return {};
    const char* how = state == NodeState::boot_up ? " was reset" : " was taken out of operation";
    return fail(Fault::link_closed, node_->name() + how);
}

void CanOpenSession::take_emergency(const Emergency& emergency) {
    register_watch_.after_emergency();
    if (emergency.is_of_communication()) return void(++counters_.bad_frames);
    in_error_ = !emergency.is_over();
    if (in_error_)
        context_.sink->note(Fault::signal_error,
                            node_->name() +
                                (emergency.code >> 8U == 0
                                     ? " reports that a fault is over and another lasts: "
                                     : " reports a fault: ") +
                                emergency.describe());
}

void CanOpenSession::take_short_frame() {
    ++counters_.bad_frames;
    context_.sink->note(Fault::bad_frame, node_->name() +
                                              " sends PDOs that are shorter than its mapping says: "
                                              "switch it off and on, and look at its mapping");
}

Result<void> CanOpenSession::take(const TimedCanFrame& timed, std::vector<PdoArrival>& arrived) {
    if (const auto state = decode_heartbeat(timed.frame, setup_.node)) {
        const bool answers = guard_.next_question() && *state != NodeState::boot_up;
        if (!answers || guard_.take(toggle_of(timed.frame), timed.at))
            return take_state(*state, timed.at);
        ++counters_.bad_frames; // an answer went lost, or a stranger sends it
        return {};
    }
    if (const auto emergency = decode_emergency(timed.frame, setup_.node)) {
        take_emergency(*emergency);
        return {};
    }
    if (const auto errors = register_watch_.take(timed.frame)) judge_error_register(*errors);
    const auto found = std::ranges::find_if(used_, [&](std::size_t index) {
        return layouts_[index].id == timed.frame.id && timed.frame.is_plain();
    });
    if (found == used_.end()) return {};
    last_pdo_ = timed.at;
    ++counters_.frames;
    arrived.push_back({*found, timed.frame, timed.at, timed.dropped, in_error_});
    return {};
}

MonotonicTime CanOpenSession::silent_from() const {
    const MonotonicTime pdo_due = last_pdo_ + std::max(3 * setup_.sample_period, least_patience);
    const MonotonicTime beat_due = beats_ ? last_beat_ + beat_patience_ : pdo_due;
    return std::min({pdo_due, beat_due, guard_.silent_from().value_or(pdo_due)});
}

/// Until something comes or the node has been silent for too long.
Task<Result<std::vector<TimedCanFrame>>> CanOpenSession::read_on() {
    if (setup_.rest > Duration::zero()) co_await context_.scheduler->sleep_for(setup_.rest);
    // A computer that slept may find that all is overdue, and frames that waited.
    const MonotonicTime least = context_.scheduler->now() + shortest_look;
    for (;;) {
        const auto guarded = co_await guard();
        if (!guarded) co_return tl::unexpected<Error>(guarded.error());
        const auto asked = co_await ask_error_register();
        if (!asked) co_return tl::unexpected<Error>(asked.error());
        const MonotonicTime end = std::max(silent_from(), least);
        const MonotonicTime look = std::min(end, guard_.next_question().value_or(end));
        auto arrived = co_await link_->read_some(look);
        counters_.bad_frames +=
            link_->bus_errors() - std::exchange(bus_errors_, link_->bus_errors());
        const bool nothing = !arrived && arrived.error().fault == Fault::link_timeout;
        if (!nothing) co_return arrived;
        if (look < end) continue; // the next question is due
        ++counters_.timeouts;
        co_return tl::unexpected<Error>(node_->silence());
    }
}

Task<Result<std::vector<PdoArrival>>> CanOpenSession::next() {
    std::vector<PdoArrival> arrived;
    while (arrived.empty()) {
        if (then_) co_return tl::unexpected<Error>(*std::exchange(then_, std::nullopt));
        AXISCAL_CO_TRY(const std::vector<TimedCanFrame> frames, co_await read_on());
        for (const TimedCanFrame& timed : frames) {
            const auto taken = take(timed, arrived);
            if (taken) continue;
            then_ = taken.error();
            break;
        }
    }
    co_return arrived;
}

} // namespace axiscal
