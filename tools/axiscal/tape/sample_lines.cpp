#include "tools/axiscal/tape/sample_lines.hpp"

#include <cstdio>

namespace axiscal {

void SampleLines::take(const Sample& sample) {
    const auto channel = static_cast<std::size_t>(sample.channel);
    text_ += "+" + std::to_string((sample.at - begin_).count()) + " ";
    text_ += channel < channels_.size() ? channels_[channel].name : std::to_string(sample.channel);
    if (const auto value = sample.value()) {
        char digits[32];
        std::snprintf(digits, sizeof digits, " %.12g", *value);
        text_ += digits;
    } else {
        text_ += " " + std::string{name_of(sample.quality())};
    }
    if (sample.device_count) text_ += " #" + std::to_string(sample.device_count);
    if (sample.device_count || sample.epoch) text_ += " epoch " + std::to_string(sample.epoch);
    text_ += "\n";
}

void SampleLines::identify(const Identity& identity) {
    text_ += "identity " + identity.maker + " | " + identity.model + " | " + identity.serial +
             " | " + identity.firmware + "\n";
}

void SampleLines::note(Fault fault, std::string sentence) {
    text_ += "note " + std::string{fault_name(fault)} + ": " + sentence + "\n";
}

void SampleLines::ended(Fault fault) {
    text_ += "ended " + std::string{fault_name(fault)} + "\n";
}

void SampleLines::count(const InstrumentCounters& counters) {
    text_ += "counters frames " + std::to_string(counters.frames) + " samples " +
             std::to_string(counters.samples) + " bad " + std::to_string(counters.bad_frames) +
             " checksum " + std::to_string(counters.checksum_errors) + " gaps " +
             std::to_string(counters.gaps) + " lost " + std::to_string(counters.lost_records) +
             " restarts " + std::to_string(counters.restarts) + " timeouts " +
             std::to_string(counters.timeouts) + "\n";
}

} // namespace axiscal
