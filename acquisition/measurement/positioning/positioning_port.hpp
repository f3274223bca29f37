#pragma once
// What a positioning run tells the CNC beyond what every test tells it, and what it works with.

#include "acquisition/measurement/cnc_answer.hpp"
#include "analysis/quantity/time.hpp"
#include "drivers/trigger/journal_receipt.hpp"
#include "drivers/trigger/trigger_port.hpp"

namespace axiscal {

/// The station, as far as it answers the CNC for a positioning run. Loop-bound.
class PositioningPort : public CncAnswer {
public:
    /// As acknowledge(), of a request that skipped its point.
    virtual void acknowledge_skip(const JournalReceipt& receipt) = 0;
    /// As publish_no_run(), also of a run that the CNC itself ended.
    virtual void end_requests(RunEnd end) = 0;
    /// Where the axis stands now, for a port that judges by it.
    virtual void publish_position(MonotonicTime at, double position_mm) = 0;
    /// STATE of what is published next; as yet nothing is.
    virtual void start_with(PortState state) = 0;
    /// Everything that the CNC may read, with the STATE that was shown last.
    virtual void publish_anew() = 0;
};

/// As CncContext, of a run that also keeps the index of air up to date.
struct PositioningContext : CncContext {
    PositioningPort& port; ///< the same as `cnc`
    LiveReadings& air;     ///< the same as `readings`
};

} // namespace axiscal
