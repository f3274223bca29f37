#pragma once
// A circular test that was open when the last daemon ended: what its file and its instruments tell
// for decide_circle_resume().

#include "acquisition/measurement/circular/circle_resume.hpp"
#include "acquisition/measurement/cnc_answer.hpp"
#include "acquisition/run/resume.hpp"
#include "analysis/quantity/time.hpp"
#include "drivers/loop/scheduler.hpp"

#include <optional>
#include <string>
#include <vector>

namespace axiscal {

struct RunFileContents;

/// Returns when the ballbar has sent something that did not wait in a buffer since before, at the
/// latest after 15.5 s. At once where the station has none.
Task<void> ballbar_is_back(CncContext context);

/// May it go on? Also an exchanged instrument ends it, and a file without a plan.
CircleResume judge_left_circles(const CncContext& context, const RunFileContents& contents);

/// The last stored sample with the instrument's own number of it; none without numbers.
std::optional<CounterSighting> last_sighting_of(const RunFileContents& contents);

/// For how long nothing was recorded, which version goes on, and at which circle.
/// @param verdict  of judge_left_circles()
std::string
interruption_text(const RunFileContents& contents, const CircleResume& verdict, MonotonicTime now);

/// Of the instruments that a circular test uses, as far as they have told one.
std::vector<InstrumentSerial> serials_of_circles(const CncContext& context);

} // namespace axiscal
