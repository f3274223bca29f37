#pragma once
// What certificates of every kind say of who, with what and what happened. Pure.

#include "analysis/record/run_record.hpp"
#include "analysis/record/run_revisions.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// The text; null when nobody said it.
nlohmann::ordered_json stated_json(const std::string& text);

/// The value; null where there is none.
template <class T> nlohmann::ordered_json stated_json(const std::optional<T>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json{};
}

nlohmann::ordered_json statements_json(const Statements& said);

/// `date`: ISO date of the run; a certificate due before it had expired.
nlohmann::ordered_json instruments_json(const std::vector<InstrumentRecord>& instruments,
                                        const std::string& date);

/// Certificates of single channels; `date` as above.
nlohmann::ordered_json calibrations_json(const std::vector<ChannelCalibration>& calibrations,
                                         const std::vector<ChannelRecord>& channels,
                                         const std::string& date);

nlohmann::ordered_json preflight_json(const std::vector<PreflightRecord>& checks);

/// `opened` tells the time of one that the clock did not.
nlohmann::ordered_json orders_json(const std::vector<OrderRecord>& orders, const ClockTie& opened);

nlohmann::ordered_json events_json(const std::vector<EventRecord>& events, const ClockTie& opened);

} // namespace axiscal
