#pragma once
// What a test tells the CNC that drives it, and what such a test works with.

#include "acquisition/measurement/measurement.hpp"
#include "analysis/quantity/boot_id.hpp"
#include "analysis/quantity/result.hpp"
#include "drivers/trigger/journal_receipt.hpp"
#include "drivers/trigger/trigger_port.hpp"

#include <cstdint>
#include <string>

namespace axiscal {

struct StationRoles;
class Supervisor;

/// The station, as far as it answers the CNC for a test. Loop-bound.
class CncAnswer {
public:
    virtual ~CncAnswer() = default;
    /// A new test takes requests: done = 0.
    virtual void publish_armed() = 0;
    /// done = the receipt's sequence.
    virtual void acknowledge(const JournalReceipt& receipt) = 0;
    /// done stays. People are told, too, unless the same was refused just before.
    virtual void refuse_on_port(std::uint16_t sequence, const Error& error) = 0;
    /// The test was broken off, and not by the CNC: done is no number of a request from now on.
    virtual void publish_no_run() = 0;
    /// STATE from now on; with it goes everything else that the CNC may read.
    virtual void show(PortState state) = 0;
};

/// As MeasurementContext, of a test that answers a CNC.
struct CncContext : MeasurementContext {
    CncAnswer& cnc;
    const StationRoles& roles;
    const Supervisor& instruments;
    const std::string& config_hash; ///< of the station file
    const BootId& boot_id;          ///< of the computer now
};

} // namespace axiscal
