#include "acquisition/measurement/squareness/earlier_lines.hpp"

#include "analysis/straightness/recorded_line_of.hpp"
#include "config/measure.hpp"

#include <cmath>
#include <utility>
#include <variant>

namespace axiscal {
namespace {

constexpr double same_factor = 1e-9; ///< relative: a factor that follows from an angle is rounded

constexpr const char* key_of_first = "squareness.first";
constexpr const char* key_of_reversal = "squareness.reversal_of";

/// As ISO 230-1 writes it: "E_YX" is the motion of X in the direction of Y.
std::string symbol_across(const std::string& axis, const std::string& across) {
    return "E_" + across + axis;
}

template <class Setup> Result<Setup> setup_of_earlier(const RunFileContents& run) {
    if (const auto* const setup = std::get_if<Setup>(&run.attachments.setup)) return *setup;
    return fail(Fault::bad_run_file, "the run " + run.run.run_id + " states no set-up");
}

Result<void> check_direction(const RunRecord& run,
                             const StraightnessSetup& earlier,
                             const SquarenessSetup& setup,
                             const std::string& axis) {
    if (earlier.across == axis) return {};
    const std::string &other = setup.optics.across, &stated = run.statements.axis;
    return refuse(Fault::bad_request, key_of_first,
                  "Run " + run.run_id + " is " + symbol_across(stated, earlier.across) + ", " +
                      stated + " measured in the direction of " + earlier.across +
                      "; with this axis, " + axis + " across " + other + ", the first must be " +
                      symbol_across(other, axis) + ": measure " + other +
                      " in that direction, or name another run");
}

/// The same prism and mirror saw both axes.
Result<void> check_optics_of(const RunRecord& run,
                             const StraightnessSetup& earlier,
                             const StraightnessSetup& now,
                             const char* key) {
    for (const StraightnessSetup* const optics : {&earlier, &now})
        if (optics->method != StraightnessMethod::wollaston)
            return refuse(Fault::bad_request, key,
                          (optics == &now ? "This axis" : "Run " + run.run_id) +
                              " is measured by angle steps, and an optical square joins lines of "
                              "one prism and mirror alone: measure both axes by \"wollaston\"");
    if (std::abs(earlier.factor - now.factor) <= same_factor * now.factor) return {};
    return refuse(Fault::bad_request, key,
                  "Run " + run.run_id + " has the factor " + write_number(earlier.factor) +
                      ", and [straightness] states " + write_number(now.factor) +
                      ": the same prism and mirror must see both axes; state the same factor, or "
                      "measure that run again");
}

Result<void> check_mirror_of(const RunRecord& run,
                             const StraightnessSetup& earlier,
                             const StraightnessSetup& now) {
    if (earlier.mirror == now.mirror) return {};
    const std::string stood{name_of(earlier.mirror)}, stands{name_of(now.mirror)};
    return refuse(Fault::bad_request, key_of_first,
                  "In run " + run.run_id + " the mirror stood " + stood + ", and now it stands " +
                      stands + ": nobody may touch it between the two lines. Say mirror = \"" +
                      stood + "\" if it stands so, else measure the first axis again");
}

Result<void>
check_axes_of(const RunRecord& run, const SquarenessSetup& earlier, const SquarenessSetup& now) {
    if (earlier.optics.across == now.optics.across) return {};
    return refuse(Fault::bad_request, key_of_reversal,
                  "Run " + run.run_id + " is of " + run.statements.axis + " across " +
                      earlier.optics.across + ", and this one across " + now.optics.across +
                      ": name a run of the same two axes");
}

Result<void> check_position_of_square(const RunRecord& run,
                                      const SquarenessSetup& earlier,
                                      const SquarenessSetup& now) {
    if (earlier.square != now.square) return {};
    const SquarePosition other =
        now.square == SquarePosition::normal ? SquarePosition::turned : SquarePosition::normal;
    return refuse(Fault::bad_request, key_of_reversal,
                  "The square stands as in run " + run.run_id + ": turn it, or say square = \"" +
                      std::string{name_of(other)} + "\" where it was turned");
}

} // namespace

Result<RecordedLine>
first_line_of(const RunFileContents& run, const SquarenessSetup& setup, const std::string& axis) {
    AXISCAL_TRY(const StraightnessSetup earlier, setup_of_earlier<StraightnessSetup>(run));
    AXISCAL_CHECK(check_direction(run.run, earlier, setup, axis));
    AXISCAL_CHECK(check_optics_of(run.run, earlier, setup.optics, key_of_first));
    AXISCAL_CHECK(check_mirror_of(run.run, earlier, setup.optics));
    return recorded_line_of(run.run, run.revisions, earlier);
}

Result<OtherSquare> other_square_of(const RunFileContents& run, const SquarenessSetup& setup) {
    AXISCAL_TRY(SquarenessSetup earlier, setup_of_earlier<SquarenessSetup>(run));
    AXISCAL_CHECK(check_axes_of(run.run, earlier, setup));
    AXISCAL_CHECK(check_optics_of(run.run, earlier.optics, setup.optics, key_of_reversal));
    AXISCAL_CHECK(check_position_of_square(run.run, earlier, setup));
    OtherSquare other;
    AXISCAL_TRY(other.second, recorded_line_of(run.run, run.revisions, earlier.optics));
    other.first = std::move(earlier.first);
    return other;
}

} // namespace axiscal
