#pragma once
// What a test that a person orders is opened with, and what speaks against one of any kind.

#include "acquisition/measurement/positioning/positioning_port.hpp"
#include "acquisition/measurement/run_header.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/run_revisions.hpp"
#include "analysis/record/test_kind.hpp"
#include "config/station_config.hpp"

#include <cstdint>
#include <memory>
#include <string>

namespace axiscal {

class BeamWatch;
class DiskWait;
class LatestTests;
class Recovery;

/// What somebody does just now and nobody else may begin beside it.
struct UnderWay {
    bool arming = false;   ///< a test is being opened
    bool revising = false; ///< a retake, an exclusion or an answer is being kept
};

/// As PositioningContext, of a test of any kind that is not open yet.
struct OrderContext : PositioningContext {
    LatestTests& tests;
    Recovery& recovery;
    const DiskWait& disk;
    BeamWatch& beam;
    UnderWay& under_way;
    const std::string& may_sleep; ///< why the computer may fall asleep; empty: it may not
};

/// No reason overrides this. @errors Fault::refused
Result<void> plays_no_tape(const StationConfig& config);
/// @errors Fault::not_durable
Result<void> disk_takes_records(const OrderContext& context);
/// No test is open, whatever its kind, and nobody opens one or adds to one. @errors Fault::busy
Result<void> nothing_goes_on(const OrderContext& context);

/// Of a test that is opened now. @param plan  of the axis; of other tests empty
RunHeaderParts header_parts(const OrderContext& context, TestKind kind, RunPlan plan);
/// It takes the place of the last one before the CNC, and records.
/// @param test  its file is open
void begin_before_cnc(const OrderContext& context,
                      const std::shared_ptr<Measurement>& test,
                      std::int64_t opened_utc_ns,
                      const Orderer& by);

} // namespace axiscal
