#pragma once
// May an open circular test go on after a restart of the daemon? Pure.

#include "acquisition/measurement/circular/circle_order.hpp"
#include "acquisition/run/resume.hpp"
#include "analysis/record/circular_setup.hpp"
#include "analysis/record/stream_record.hpp"

#include <optional>
#include <string>

namespace axiscal {

/// What the run file holds of the test.
struct RecordedCircles {
    const RunRecord& run;
    const CircularSetup& setup;
    const StreamSamples& stream;
    std::optional<CounterSighting> last; ///< of the bar's last stored sample
};

/// The bar as it is after the restart.
struct BarNow {
    std::string config_hash;
    BootId boot_id;
    bool incremental = false;  ///< its zero holds only while it counts on
    bool speaks = false;       ///< at rest it may be out of its range
    std::optional<Sample> bar; ///< its newest sample, if that is good
    ContinuityLimits limits;
};

struct CircleResume {
    enum class Decision : std::uint8_t {
        go_on,
        close_complete,  ///< every circle is durable, only the closing row is missing
        close_incomplete ///< the reason in `sentence`
    };
    Decision decision = Decision::close_incomplete;
    Fault fault = Fault::none;
    std::string sentence; ///< goes on the record either way
    CirclesBefore before; ///< of `go_on`
};

/// The readings of a test have one zero and one clock: another boot of the computer, another
/// station file, or an interferometer that is not proven to have counted on, ends it. A bar that
/// measures a length by itself (transducer, gauge) keeps its zero.
CircleResume decide_circle_resume(const RecordedCircles& from, const BarNow& now);

} // namespace axiscal
