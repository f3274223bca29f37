#pragma once
// Everything an instrument hands up, as text lines that can be compared.

#include "drivers/instrument.hpp"

#include <cstdio>
#include <string>
#include <vector>

namespace axiscal::testing {

/// "+<ns> <channel> <value> #<device count> epoch <n>"; times count from `begin`.
class SampleRecorder final : public SampleSink {
public:
    explicit SampleRecorder(MonotonicTime begin = {}, bool with_times = true)
        : begin_{begin}
        , with_times_{with_times} {}

    void take(const Sample& sample) override {
        samples.push_back(sample);
        lines.push_back(line_of(sample));
    }
    void identify(const Identity& who) override {
        identities.push_back(who);
        lines.push_back("identity " + who.maker + " | " + who.model + " | " + who.serial + " | " +
                        who.firmware);
    }
    void note(Fault fault, std::string sentence) override {
        notes.push_back(fault);
        lines.push_back("note " + std::string{fault_name(fault)} + ": " + sentence);
    }
    void name_channels(const std::vector<Channel>& channels) { channels_ = channels; }
    [[nodiscard]] std::string text() const {
        std::string all;
        for (const auto& line : lines)
            all += line + "\n";
        return all;
    }

    std::vector<std::string> lines;
    std::vector<Sample> samples;
    std::vector<Identity> identities;
    std::vector<Fault> notes;

private:
    [[nodiscard]] std::string line_of(const Sample& sample) const {
        const auto channel = static_cast<std::size_t>(sample.channel);
        std::string line =
            with_times_ ? "+" + std::to_string((sample.at - begin_).count()) + " " : std::string{};
        line +=
            channel < channels_.size() ? channels_[channel].name : std::to_string(sample.channel);
        if (const auto value = sample.value()) {
            char digits[32];
            std::snprintf(digits, sizeof digits, " %.12g", *value);
            line += digits;
        } else {
            line += " " + std::string{name_of(sample.quality())};
        }
        if (sample.device_count) line += " #" + std::to_string(sample.device_count);
        if (sample.device_count || sample.epoch) line += " epoch " + std::to_string(sample.epoch);
        return line;
    }

    std::vector<Channel> channels_;
    MonotonicTime begin_;
    bool with_times_;
};

inline std::string text_of(const InstrumentCounters& counters) {
    return "counters frames " + std::to_string(counters.frames) + " samples " +
           std::to_string(counters.samples) + " bad " + std::to_string(counters.bad_frames) +
           " checksum " + std::to_string(counters.checksum_errors) + " gaps " +
           std::to_string(counters.gaps) + " lost " + std::to_string(counters.lost_records) +
           " restarts " + std::to_string(counters.restarts) + " timeouts " +
           std::to_string(counters.timeouts);
}

} // namespace axiscal::testing
