#pragma once
// The times of a run as paper tells them: from one reading of the clock, however it is set
// afterwards. Pure.

#include "analysis/record/run_record.hpp"
#include "analysis/record/run_revisions.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// An event of kind interrupted, note or closed whose text holds these words stands where the rows
/// of another boot of the computer begin: their monotonic times count from anew.
constexpr std::string_view computer_restarted = "the computer was restarted";
bool begins_another_boot(const EventRecord& event);

/// computer_restarted, or, where one of the two is unknown, that nobody can tell whether it was;
/// these words hold computer_restarted, too. For boots that are not the same.
std::string restart_text(const BootId& earlier, const BootId& later);

/// The UTC of each row within the boot of the opening follows from the row's monotonic time and the
/// triple of the opening, that of a later boot from its first event. Where neither reaches (a time
/// before the tie is of another boot, whatever else is said) the clock's own reading stands.
///
/// What the run file stores is what the clock said at each moment; it is not touched: only this
/// copy is. `retakes`: ordered beside the points.
/// @returns how far the clock was at most from what is told now; zero or more
Duration tell_times_by_one_clock(const ClockTie& opened,
                                 std::vector<EventRecord>& events,
                                 std::vector<RetakeRecord>& retakes,
                                 ClockTie& closed);

/// The same for the orders: to arm was ordered at the opening, all else beside the points.
void tell_orders_by_one_clock(const ClockTie& opened,
                              const std::vector<EventRecord>& events,
                              std::vector<OrderRecord>& orders);

/// What the monotonic times of points and orders count by. A datum does not outlive a boot: a run
/// that went on in another one measured everything in the last.
ClockTie tie_of_points(const ClockTie& opened, const std::vector<EventRecord>& events);

/// One sentence for a clock that was set in mid-run; empty below 2 s.
std::string remark_on_clock(Duration farthest);

} // namespace axiscal
