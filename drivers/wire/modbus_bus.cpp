#include "drivers/wire/modbus_bus.hpp"

#include "drivers/framing/modbus_answers.hpp"
#include "drivers/wire/turns.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

namespace axiscal {
namespace {

constexpr Duration opening_patience = std::chrono::seconds{5};
constexpr Duration connecting_patience = std::chrono::seconds{1}; // other units wait meanwhile

ModbusQuestion question_of(const ModbusRead& request) {
    return {static_cast<std::uint8_t>(request.unit_id), static_cast<std::uint8_t>(request.function),
            static_cast<std::uint16_t>(request.address), request.count};
}

/// Modbus application protocol V1.1b3, 7. What a gateway says of a unit that it does not reach is
/// that unit's silence, and so is "later".
bool means_silence(int exception) {
    return exception == 5 || exception == 6 || exception == 10 || exception == 11;
}

std::string exception_text(int exception) {
    const std::string number = "exception " + std::to_string(exception);
    switch (exception) {
    case 1: return number + " (it does not know this function)";
    case 2: return number + " (it has no such register)";
    case 3: return number + " (it does not read so many registers at once)";
    case 4: return number + " (it failed)";
    case 5: return number + " (it needs more time)";
    case 6: return number + " (it is busy)";
    case 8: return number + " (its memory is damaged)";
    case 10: return number + " (the gateway has no way to it)";
    case 11: return number + " (the gateway gets no answer from it)";
    default: return number;
    }
}

/// The line's own name, however it was asked for: /dev/serial/by-id has links.
LinkSettings by_its_own_name(LinkSettings settings) {
    if (settings.kind != LinkSettings::Kind::serial) return settings;
    std::error_code unknown;
    const auto path = std::filesystem::weakly_canonical(settings.path, unknown);
    if (!unknown) settings.path = path.string();
    return settings;
}

} // namespace

class ModbusBus::Line {
public:
    Line(LinkSettings settings, Scheduler& scheduler, LinkOpener& opener)
        : settings_{std::move(settings)}
        , scheduler_{scheduler}
        , opener_{opener}
        , turns_{scheduler.executor()} {}

    /// The unit's turn, when no answer of it can come any more.
    Task<Turns::Turn> turn_of(int unit_id) {
        for (;;) {
            co_await scheduler_.sleep_until(owed_until(unit_id));
            Turns::Turn turn = co_await turns_.take();
            if (owed_until(unit_id) <= scheduler_.now()) co_return turn;
        }
    }
    /// In its turn.
    Task<Result<ModbusWords>> converse(ModbusRead request) {
        const auto ready = co_await make_ready(request);
        if (!ready) {
            link_.reset();
            co_return tl::unexpected<Error>(ready.error());
        }
        const MonotonicTime asked_at = scheduler_.now();
        // Before it is asked: whoever asks may be cancelled while it waits.
        if (is_serial())
            owed_until_[request.unit_id] = asked_at + std::max(latest_answer, 2 * request.timeout);
        auto answered = co_await ask(request, asked_at);
        if (answered_) owed_until_.erase(request.unit_id);
        const bool closed = !answered && answered.error().fault == Fault::link_closed;
        if (closed || all_are_silent(request.unit_id)) link_.reset();
        co_return answered;
    }

private:
    [[nodiscard]] bool is_serial() const { return settings_.kind == LinkSettings::Kind::serial; }
    [[nodiscard]] MonotonicTime owed_until(int unit_id) const {
        const auto owed = owed_until_.find(unit_id);
        return owed == owed_until_.end() ? MonotonicTime{} : owed->second;
    }
    [[nodiscard]] tl::unexpected<Error>
    failed(Fault fault, int unit_id, const std::string& what) const {
        return fail(fault, "unit " + std::to_string(unit_id) + " on " + settings_.describe() +
                               ": " + what);
    }

    /// ftdi_sio stops reading for good at a STALL, until its next opening, and a TCP peer that lost
    /// its power never says so: a line is opened anew where each of its units was asked in vain
    /// since a byte came.
    bool all_are_silent(int unit_id) {
        units_.insert(unit_id);
        if (heard_)
            silent_.clear();
        else
            silent_.insert(unit_id);
        return silent_.size() == units_.size();
    }

    Task<Result<void>> make_ready(const ModbusRead& request);
    Task<Result<void>> fall_silent(Duration still, Duration patience);
    Task<Result<ModbusWords>> ask(ModbusRead request, MonotonicTime asked_at);
    Result<ModbusWords> judged(const ModbusRead& request, ModbusAnswer answer);

    const LinkSettings settings_;
    Scheduler& scheduler_;
    LinkOpener& opener_;
    Turns turns_;
    std::unique_ptr<ByteLink> link_;
    TcpAnswers connection_;
    std::uint16_t transaction_ = 0;
    bool heard_ = false;    ///< a byte since the last request
    bool answered_ = false; ///< by a whole frame, perhaps an exception
    bool was_open_ = false;
    std::set<int> units_, silent_; ///< all that were asked; those asked in vain since a byte came
    std::map<int, MonotonicTime> owed_until_; ///< by unit
};

/// An open line on which nobody speaks.
Task<Result<void>> ModbusBus::Line::make_ready(const ModbusRead& request) {
    Duration still = request.gap;
    if (!link_) {
        const Duration patience =
            is_serial() ? opening_patience : std::max(connecting_patience, request.timeout);
        auto opened = co_await opener_.open(settings_, scheduler_.now() + patience);
        if (!opened) co_return tl::unexpected<Error>(opened.error());
        link_ = *std::move(opened);
        connection_ = {};
        silent_.clear();
        // Whoever used the line before this station may have asked and gone.
        if (is_serial() && !std::exchange(was_open_, true))
            still = std::max(still, request.timeout);
    }
    if (is_serial()) {
        auto silent = co_await fall_silent(still, request.timeout);
        co_return silent;
    }
    co_await scheduler_.sleep_for(still);
    co_return Result<void>{};
}

/// Reads until nothing has come for as long as `still`.
Task<Result<void>> ModbusBus::Line::fall_silent(Duration still, Duration patience) {
    MonotonicTime since = scheduler_.now();
    const MonotonicTime end = since + still + patience;
    for (;;) {
        const auto late = co_await link_->read_some(std::min(since + still, end));
        if (!late && late.error().fault != Fault::link_timeout)
            co_return tl::unexpected<Error>(late.error());
        if (!late && scheduler_.now() >= since + still) co_return Result<void>{};
        if (late) since = late->read_at;
        if (scheduler_.now() >= end)
            co_return fail(Fault::bad_frame,
                           settings_.describe() +
                               " is never silent: does another master ask on it?");
    }
}

Task<Result<ModbusWords>> ModbusBus::Line::ask(ModbusRead request, MonotonicTime asked_at) {
    const ModbusQuestion question = question_of(request);
    const MonotonicTime deadline = asked_at + request.timeout;
    RtuAnswer frame{question};
    heard_ = answered_ = false;
    ++transaction_;
    std::vector<std::byte> bytes =
        is_serial() ? rtu_request(question) : tcp_request(question, transaction_);
    const auto written = co_await link_->write_all(std::move(bytes), deadline);
    if (!written) co_return tl::unexpected<Error>(written.error());
    for (;;) {
        const auto some = co_await link_->read_some(deadline);
        if (!some && some.error().fault == Fault::link_timeout)
            co_return failed(Fault::link_timeout, request.unit_id, "no answer");
        if (!some) co_return tl::unexpected<Error>(some.error());
        heard_ = true;
        is_serial() ? frame.feed(some->bytes) : connection_.feed(some->bytes);
        auto answer = is_serial() ? frame.take() : connection_.take(question, transaction_);
        if (!answer) continue;
        auto words = judged(request, *std::move(answer));
        if (words) words->asked_at = asked_at;
        if (words) words->read_at = some->read_at;
        co_return words;
    }
}

Result<ModbusWords> ModbusBus::Line::judged(const ModbusRead& request, ModbusAnswer answer) {
    using Kind = ModbusAnswer::Kind;
    answered_ = answer.kind == Kind::words || answer.kind == Kind::exception;
    switch (answer.kind) {
    case Kind::words: return ModbusWords{std::move(answer.words), {}, {}};
    case Kind::exception:
        return failed(means_silence(answer.exception) ? Fault::link_timeout : Fault::refused,
                      request.unit_id, exception_text(answer.exception));
    case Kind::damaged:
        return failed(Fault::checksum, request.unit_id, "the checksum of its answer is wrong");
    case Kind::another:
        return failed(Fault::bad_frame, request.unit_id, "what came is no answer to the request");
    case Kind::out_of_step: break;
    }
    link_.reset();
    return failed(Fault::bad_frame, request.unit_id, "what came is not Modbus");
}

ModbusBus::ModbusBus(LinkSettings settings, Scheduler& scheduler, LinkOpener& opener)
    : line_{std::make_shared<Line>(std::move(settings), scheduler, opener)} {}

ModbusBus::~ModbusBus() = default;

Task<Result<ModbusWords>> ModbusBus::read(ModbusRead request) {
    const std::shared_ptr<Line> line = line_;
    const Turns::Turn turn = co_await line->turn_of(request.unit_id);
    auto answered = co_await line->converse(request);
    co_return answered;
}

Result<ModbusBus*> ModbusBuses::bus(const LinkSettings& settings) {
    const LinkSettings own = by_its_own_name(settings);
    const bool serial = own.kind == LinkSettings::Kind::serial;
    auto& line = buses_[serial ? own.path : own.describe()];
    if (!line.bus)
        line = {own.describe(), std::make_unique<ModbusBus>(settings, scheduler_, opener_)};
    if (line.asked != own.describe())
        return fail(Fault::bad_configuration,
                    settings.describe() + ": another instrument uses this line as " + line.asked);
    return line.bus.get();
}

} // namespace axiscal
