#pragma once
// Certificate and key of [console], looked at before they are used: by `axiscal check-config` and
// by the start of the daemon. Whoever reads a station file for something else does not need the
// key.

#include "config/station_config.hpp"

#include <cstdint>
#include <vector>

namespace axiscal {

struct TlsJudgement {
    std::vector<Refusal> refusals; ///< any: TLS cannot be spoken
    std::vector<Refusal> notes;
};

/// Nothing where the station file names no certificate; then no module is loaded either.
TlsJudgement judge_tls(const StationConfig& station, std::int64_t utc_ns);

} // namespace axiscal
