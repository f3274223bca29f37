#pragma once
// What a shop is told of a run: that it is complete, or that something is wrong with it. Pure.

#include "analysis/quantity/result.hpp"
#include "analysis/record/test_kind.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace axiscal {

struct StationEvent {
    enum class About : std::uint8_t { complete, fault };
    About about = About::complete;
    std::string when_utc; ///< ISO time
    std::string run_id;
    std::optional<TestKind> test;   ///< of a complete run
    std::string certificate;        ///< of a complete run: the name of its folder
    std::string parameter, verdict; ///< the figure that the verdict rests on; empty: no limits
    Fault fault = Fault::none;      ///< of a fault
    std::string sentence;           ///< of a fault: what is seen and what to do next
};

/// "complete", "fault": `on` of the station file, "kind" of the body.
std::string name_of(StationEvent::About about);

/// The same for the same happening, whoever makes it again: a certificate of a run, a kind of fault
/// in a run. A receiver that has seen it has had the event.
std::string event_id(const StationEvent& event);

/// The body of the POST (docs/webhook.md), one line of at most 8 KiB; a longer sentence is cut.
/// @param dropped  events that were dropped so far, where any were
std::string event_body(const StationEvent& event, const std::string& station, std::int64_t dropped);

} // namespace axiscal
