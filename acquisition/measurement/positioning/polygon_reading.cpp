#include "acquisition/measurement/positioning/polygon_reading.hpp"

#include "acquisition/capture/wording.hpp"

#include <string>

namespace axiscal {
namespace {

constexpr double arcsec_per_degree = 3600;

/// A micrometre stands for a thousandth of a degree.
std::string arcsec_of_um(double thousandths) {
    return plain_number(thousandths * arcsec_per_degree / 1000, 2) + " arcsec";
}

} // namespace

Capture typed_capture(double seconds_of_arc, MonotonicTime now) {
    Capture capture;
    capture.begin = capture.end = now;
    capture.mean = mm(seconds_of_arc / arcsec_per_degree);
    capture.n = 1;
    return capture;
}

Sample in_degrees(const Sample& shown) {
    const auto seconds_of_arc = shown.value();
    Sample kept = seconds_of_arc ? Sample{shown.channel, shown.at,
                                          mm(*seconds_of_arc / arcsec_per_degree).si()}
                                 : Sample::bad(shown.channel, shown.at, Quality::absent);
    kept.time_uncertainty = shown.time_uncertainty;
    return kept;
}

Error no_still_face(const StillnessVerdict& seen, const CaptureConfig& limits) {
    const WindowStatistics& found = seen.statistics;
    std::string why = "its readings spread over " + arcsec_of_um(found.spread.in(um)) +
                      " and drift by " + arcsec_of_um(found.slope_um_per_s) + "/s, " +
                      arcsec_of_um(limits.spread_limit.in(um)) + " and " +
                      arcsec_of_um(limits.slope_limit_um_per_s) + "/s are allowed";
    if (found.n == 0)
        why = "it shows no face, or does not answer";
    else if (seen.fault == Fault::signal_error)
        why = "the light was lost on the way";
    else if (found.n < limits.minimum_samples)
        why = "a window of " + in_seconds(limits.window) + " holds " + counted(found.n, "reading") +
              ", " + std::to_string(limits.minimum_samples) +
              " are needed: a shorter poll_period, or a longer capture.window";
    return {Fault::not_still,
            "The autocollimator shows no still face within " + in_seconds(limits.timeout) + ": " +
                why + ".",
            {},
            {}};
}

} // namespace axiscal
