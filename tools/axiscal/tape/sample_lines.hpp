#pragma once
// Everything an instrument hands up, as the lines of an expectation (tests/traces/README.md).

#include "drivers/instrument.hpp"

#include <string>
#include <vector>

namespace axiscal {

/// "+<ns> <channel> <value> #<device count> epoch <n>"; times count from `begin`. Identities, notes
/// and the fault that ended a connection are lines of their own.
class SampleLines final : public SampleSink {
public:
    SampleLines(MonotonicTime begin, std::vector<Channel> channels)
        : begin_{begin}
        , channels_{std::move(channels)} {}
    void take(const Sample& sample) override;
    void identify(const Identity& identity) override;
    void note(Fault fault, std::string sentence) override;
    void ended(Fault fault);
    void count(const InstrumentCounters& counters);
    [[nodiscard]] const std::string& text() const { return text_; }

private:
    MonotonicTime begin_;
    std::vector<Channel> channels_;
    std::string text_;
};

} // namespace axiscal
