#pragma once
// The drift test that a budget takes its E_VE from. Blocking calls.

#include "analysis/quantity/quantity.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/quantity/time.hpp"

#include <string>

namespace axiscal {

/// A stored result of a drift test.
struct StoredDrift {
    std::string run_id, document;
    Duration duration{}; ///< as long as it was to last: it is complete
    Length place;        ///< where the axis rested, as was stated; 0 for a ballbar
};
/// Which drift test a budget takes its E_VE from.
struct WantedDrift {
    std::string which;   ///< a run id, or "latest": the newest one
    bool of_bar = false; ///< of a ballbar, else of an axis
    std::string of;      ///< name of the axis, or channel of the ballbar: "gauge/axis 1"
    /// The key of the station file that names it, and the order that makes another.
    [[nodiscard]] std::string key() const;
    [[nodiscard]] std::string order() const;
};
/// Only complete tests of that axis or ballbar that were evaluated count.
/// @errors Fault::not_found, with the way out.
Result<StoredDrift> find_drift(const std::string& folder, const WantedDrift& wanted);

} // namespace axiscal
