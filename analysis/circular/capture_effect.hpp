#pragma once
// What averaging and filter of the bar's electronics leave of the form, and what they do to G.
// Pure.

#include "analysis/circular/circular_test.hpp"
#include "analysis/record/circular_setup.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// Of an undulation of the radius, so many to a whole turn.
struct UndulationGain {
    int per_revolution = 0;
    double frequency_hz = 0; ///< in the readings, at the programmed feed
    double gain = 1;         ///< amplitude that is left, 0 to 1
};

struct CaptureEffect {
    CircularCapture capture;
    /// Of 2, 5, 15, 50, 150 and 500 undulations; empty where nothing is averaged or filtered, and
    /// where `not_known` says why.
    std::vector<UndulationGain> gains;
    std::optional<double> one_percent_per_revolution; ///< undulations that lose 1 % of amplitude
    /// By contract key (G_ccw, G_cw, G_b): G of the readings that are averaged and filtered once
    /// more, minus G. Empty where `not_known` says why.
    std::map<std::string, double> done_again_mm;
    std::string not_known; ///< a sentence; empty: all of it is known
};

/// Whether the readings are not what the transducer gave.
inline bool is_changed(const CircularCapture& capture) {
    return capture.averaged > 1 || capture.low_pass_hz.has_value();
}

/// Amplitude that is left of a sinusoid of `frequency_hz`, 0 to 1:
/// - n readings, evenly over the time T = 1 / sample_rate from one stored reading to the next,
///   averaged into one: |sin(pi f T) / (n sin(pi f T / n))|, for many |sinc(f T)|;
/// - low pass with the cut-off f_c, where 1/sqrt(2) is left, taken as one of first order:
///   1 / sqrt(1 + (f/f_c)^2). Below f_c those of higher order (Butterworth, Bessel) and running
///   means leave more.
/// `capture.sample_rate_hz` is above 0 where readings are averaged.
double capture_gain(const CircularCapture& capture, double frequency_hz);

/// The readings of `trace`, in the order driven, as the same electronics would give them if they
/// were put in once more; what a low pass needs to settle (6 / (2 pi f_c) after the first reading
/// and after a gap) is left out of both, and its delay is taken back.
struct DoneAgain {
    CircularTrace once, again;
};
DoneAgain done_again(const CircularTrace& trace,
                     const CircularCapture& capture,
                     double nominal_radius_mm,
                     double feed_mm_per_s);

/// What is lost was never recorded. The gains say what the electronics can show at all; doing the
/// same once more says what of G it costs: of an undulation with the gain H the first time took
/// 1 - H of the true amplitude, the second takes H (1 - H), which is the same to first order and
/// a little less.
CaptureEffect capture_effect(const CircularTest& test, const CircularCapture& capture);

} // namespace axiscal
