#pragma once
// What differs from one kind of test to the next, as far as the station, Recovery and the
// pre-flight checks ask: one row a kind. The row NAME_kind of TestKind::NAME stands at the end of
// NAME/NAME_kind.cpp; CMake lists them.

#include "acquisition/live/station_interface.hpp"
#include "acquisition/measurement/drift/environmental_variation.hpp"
#include "acquisition/measurement/left_run.hpp"
#include "acquisition/measurement/order_context.hpp"
#include "acquisition/measurement/positioning/set_up_watch.hpp"
#include "acquisition/preflight/preflight.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "acquisition/runfile/stored_drift.hpp"
#include "analysis/quantity/quantity.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/quantity/time.hpp"
#include "analysis/record/run_record.hpp"
#include "analysis/record/test_kind.hpp"
#include "config/station_config.hpp"
#include "drivers/loop/scheduler.hpp"
#include "drivers/trigger/journal_receipt.hpp"

#include <any>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// How a CNC drives a test whose targets are not those of [cycle].
struct DrivenPlan {
    RunPlan plan; ///< `pass` is the name of the kind
    Speed feed;
    Duration dwell{};
};

struct MeasurementKind {
    /// One of them goes on at most, and a CNC may wait for it at a request.
    bool driven_by_cnc = true;

    /// Reads the table of the station file that only this kind has: what config_of() gives.
    /// Refusals stay in the table. Null: its set-up names no `section`.
    std::any (*read)(Settings section, const StationConfig& station) = nullptr;

    /// Nothing where the station file does not have this test. Null: a kind without such a plan.
    std::optional<DrivenPlan> (*driven)(const StationConfig& station) = nullptr;

    /// Of one that an earlier daemon left open. May wait until its instruments speak.
    /// @errors as Journal::reopen.
    Task<Result<TakenOver>> (*take_over)(PositioningContext context, LeftRun left) = nullptr;
    /// Of one that is complete and closed, for a person who adds to it: as
    /// take_over_closed_positioning(). Null: nothing is added to this kind.
    Task<std::shared_ptr<Measurement>> (*take_over_closed)(
        PositioningContext context,
        std::string path,
        RunFileContents contents,
        const SetUpWatch& set_up,
        const std::optional<JournalReceipt>& told) = nullptr;
    /// Where take_over_closed is null: says so, and what to do. Fault::no_run_armed.
    tl::unexpected<Error> (*refuse_addition)(const RunSummary& newest) = nullptr;

    // How one is armed. All are null of a kind that is not: a drift test is ordered by
    // open_drift(). What follows is_set_up is asked only where that holds.
    /// Names of ArmRequest::options that it takes; open() judges their values.
    std::span<const std::string_view> options = {};
    /// The station has what this kind is measured with.
    bool (*is_set_up)(const OrderContext& context) = nullptr;
    /// As StationInterface::arm. Judges by itself whether the station has what it needs.
    Task<Result<std::string>> (*open)(OrderContext context, ArmRequest request) = nullptr;
    /// For the pre-flight checks. @returns the channels of the instruments that the test uses, in
    /// the order in which the checks speak of them.
    std::vector<int> (*add_facts)(const OrderContext& context, PreflightFacts& facts) = nullptr;
    /// The drift test that the station file points to; WantedDrift::which is empty where it does
    /// not.
    WantedDrift (*wanted_drift)(const OrderContext& context) = nullptr;
    /// Of the drift test that was found. @errors as plan_for.
    Result<EveFacts> (*eve_facts)(const OrderContext& context,
                                  const ArmRequest& request,
                                  const FoundEve& found) = nullptr;
};

/// Made from kind_rows.cpp.in.
const MeasurementKind& kind_row(TestKind kind);

/// @errors Fault::bad_request for an option that the kind does not take.
Result<void> check_options(const ArmRequest& request);

/// As StationInterface::arm. A kind that is not armed is refused as a pass that the axis does not
/// plan. @errors also those of check_options().
Task<Result<std::string>> open_ordered(OrderContext context, ArmRequest request);

/// Whose readings the pre-flight checks look at: those of the kind that is asked for where it is
/// set up, else those of the first one that is; positioning where none is.
TestKind kind_that_is_checked(const OrderContext& context, const ArmRequest& request);

} // namespace axiscal
