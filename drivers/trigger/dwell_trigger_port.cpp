#include "drivers/trigger/dwell_trigger_port.hpp"

#include "drivers/trigger/register_map.hpp"

#include <cmath>
#include <cstdio>
#include <exception>

namespace axiscal {
namespace {

constexpr auto nothing_to_do = std::chrono::hours{1};

DwellLimits limits_of(const TriggerConfig& config) {
    return DwellLimits{config.window.in(mm), config.stability_range.in(mm), config.stability_period,
                       config.minimum_halt, config.hysteresis.in(mm)};
}

std::int32_t counts_of(double nominal_mm, AxisKind kind) {
    const double counts_per_mm = kind == AxisKind::rotary ? 1e5 : 1e4; // 1e-5 degree, 0.1 um
    return static_cast<std::int32_t>(std::lround(nominal_mm * counts_per_mm));
}

} // namespace

DwellTriggerPort::DwellTriggerPort(const TriggerConfig& config)
    : config_{config}
    , detector_{limits_of(config)} {}

Task<Result<void>> DwellTriggerPort::run(TriggerContext context) {
    context_ = context;
    try {
        for (;;)
            co_await context.scheduler->sleep_for(nothing_to_do);
    } catch (const std::exception&) { // cancelled: the way a port ends
    }
    context_ = {};
    co_return fail(Fault::link_closed, describe() + " was stopped.");
}

void DwellTriggerPort::publish_armed() {
    done_ = 0;
    detector_.reset();
}

void DwellTriggerPort::acknowledge(const JournalReceipt& receipt) {
    done_ = receipt.sequence();
    detector_.finished();
}

void DwellTriggerPort::refuse(std::uint16_t /*sequence*/, Fault fault) {
    detector_.failed(fault == Fault::not_still || fault == Fault::environment_stale ||
                     fault == Fault::environment_outside);
}

void DwellTriggerPort::publish(const PortStatus& status) {
    status_ = status;
    detector_.aim(status.next_nominal_mm);
}

void DwellTriggerPort::position(MonotonicTime at, double position_mm) {
    if (!context_.sink || !detector_.position(at, position_mm)) return;
    TriggerEvent event;
    event.sequence = next_sequence(done_);
    event.at = at;
    event.origin = TriggerOrigin::dwell;
    event.target_index = status_.next_target;
    event.nominal_counts = counts_of(*status_.next_nominal_mm, status_.axis_kind);
    context_.sink->on_trigger(event);
}

std::string DwellTriggerPort::describe() const {
    char text[96];
    std::snprintf(text, sizeof text, "dwell, window %.3g mm, still within %.3g um over %.3g s",
                  config_.window.in(mm), config_.stability_range.in(um),
                  seconds_of(config_.stability_period));
    return text;
}

} // namespace axiscal
