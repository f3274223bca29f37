#pragma once
// The commands that need a running axiscald.

#include "tools/axiscal/station_client.hpp"

#include <map>
#include <optional>
#include <string>

namespace axiscal {

int command_status(const StationClient& client, bool json);
/// Shows progress until the open run ends: 0 complete, 6 incomplete; 1 if `until_published` waited
/// for a certificate that cannot be written. Twice a second and more on
/// a terminal, one line a point elsewhere, each status whole with `json`.
int command_watch(const StationClient& client, bool json, bool until_published);

struct ArmOrder {
    std::optional<double> datum_mm;
    std::optional<std::uint64_t> seed;
    std::string pass = "whole";
    std::string program; ///< file whose header names seed and pass
    bool datum_by_cnc = false;
    std::map<std::string, std::string> statements, overrides;
    std::map<std::string, std::string> options; ///< what one kind of test alone is told
    std::string by; ///< who orders; empty: the daemon knows the user alone
};
int command_arm(const StationClient& client, const ArmOrder& order, bool json);
/// Every check before arming with its verdict; 4 when one of them fails.
int command_preflight(const StationClient& client, const ArmOrder& order, bool json);

struct RevisionOrder {
    std::optional<int> target, cycle; ///< counted from 1
    std::string direction;            ///< "up" | "down" | empty: both
    std::string reason, by;
};
int command_retake(const StationClient& client, const RevisionOrder& order, bool json);
int command_exclude(const StationClient& client, const RevisionOrder& order, bool json);

/// What a person answers to a finding about the set-up of the last run.
struct FindingAnswer {
    std::string finding, text, by;
};
int command_answer(const StationClient& client, const FindingAnswer& answer, bool json);
int command_trigger(const StationClient& client, bool json);
/// What the autocollimator shows at the next face of the polygon.
int command_reading(const StationClient& client, double seconds_of_arc, bool json);
/// `by`: who orders it; may be empty, as `reason`.
int command_abort(const StationClient& client,
                  const std::string& reason,
                  const std::string& by,
                  bool json);

} // namespace axiscal
