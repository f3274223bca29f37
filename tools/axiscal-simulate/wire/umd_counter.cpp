#include "wire/umd_counter.hpp"

#include <cmath>

namespace axiscal::simulate {

namespace {

/// Split frequency of a two-frequency HeNe head; leaves 480 mm/s before the slew error.
constexpr double reference_hz = 1.638e6;

double nominal_rate_hz(const std::string& kind) {
    if (kind == "umd0") return 244.14;
    if (kind == "umd1") return 610.35; // 40 MHz / 65536
    return 1000.0;
}

} // namespace

std::string encode(const UmdRecord& r) {
    std::string line;
    for (const std::int64_t field : {r.reference, r.measured, r.displacement, r.velocity, r.phase,
                                     r.sequence, r.low_speed_code, r.low_speed_data})
        line += (line.empty() ? "" : " ") + std::to_string(field);
    if (r.further_axes)
        for (const std::int64_t field : *r.further_axes)
            line += " " + std::to_string(field);
    return line + "\r\n";
}

UmdCounter::UmdCounter(LaserScenario laser)
    : laser_{std::move(laser)}
    , heterodyne_{laser_.kind == "umd1" || laser_.kind == "umd2-heterodyne"}
    , rate_hz_{laser_.rate_hz.value_or(nominal_rate_hz(laser_.kind))}
    , reference_{heterodyne_ ? std::llround(reference_hz / rate_hz_) : 0}
    , fields_{laser_.fields} {}

void UmdCounter::restart() {
    sequence_ = displacement_ = 0;
    offset_counts_ = 0;
}

void UmdCounter::follow(double counts, UmdRecord& record) {
    const double total = counts + offset_counts_;
    const std::int64_t before = displacement_;
    if (!heterodyne_) {
        displacement_ = std::llround(total);
        record.velocity = displacement_ - before;
        return;
    }
    const std::int64_t parts = std::int64_t{1} << laser_.phase_bits;
    displacement_ = static_cast<std::int64_t>(std::ceil(total));
    const double fraction = static_cast<double>(displacement_) - total;
    record.phase = std::llround(fraction * static_cast<double>(parts));
    if (record.phase == parts) record.phase = 0, --displacement_;
    record.velocity = displacement_ - before;
    record.reference = reference_;
    record.measured = std::max<std::int64_t>(0, reference_ + record.velocity);
}

void UmdCounter::run_without_beam(double counts, UmdRecord& record) {
    record.reference = reference_;
    displacement_ -= reference_;
    record.velocity = -reference_;
    if (laser_.kind == "umd1") record.phase = umd1_no_measured_edge;
    offset_counts_ = static_cast<double>(displacement_) - counts;
}

UmdRecord UmdCounter::next(double cycles) {
    UmdRecord record;
    const double counts = cycles * laser_.counts_per_cycle;
    if (beam_)
        follow(counts, record);
    else
        run_without_beam(counts, record);
    if (mask_ != 0) record.phase = mask_;
    record.displacement = displacement_;
    sequence_ += 1 + skip_;
    skip_ = 0;
    record.sequence = laser_.kind == "umd0" ? static_cast<std::int16_t>(sequence_) : sequence_;
    add_low_speed(record);
    if (fields_ == 16) record.further_axes.emplace();
    return record;
}

std::int64_t UmdCounter::version_word() const {
    if (laser_.kind == "umd0") return 90;
    if (laser_.kind == "umd1") return 60;
    return 264 + (7 << 16);
}

/// The slot is the low bits of SEQ; every other slot says code 0, data 0.
void UmdCounter::add_low_speed(UmdRecord& record) const {
    const bool umd0 = laser_.kind == "umd0", umd1 = laser_.kind == "umd1";
    const std::int64_t slot = sequence_ & (umd0 ? 0xFF : 0x1F);
    const auto say = [&](std::int64_t code, std::int64_t data) {
        record.low_speed_code = code;
        record.low_speed_data = data;
    };
    if (slot == 1) say(10, version_word());
    // The firmware prints the rate cut to hundredths: 24414, 61035, 100000.
    if (slot == 2) say(8, std::llround(rate_hz_ * 100.0));
    if (umd1 && slot >= 3 && slot <= 6) say(slot, -1); // no sensors fitted
    if (slot == (umd0 ? 13 : 3) && !umd1)
        say(20, (heterodyne_ ? 0 : 1) + laser_.counts_per_cycle * 256);
    if (!umd0 && !umd1 && slot == 14) say(112, laser_.phase_bits == 8 ? 6 : 4);
}

} // namespace axiscal::simulate
