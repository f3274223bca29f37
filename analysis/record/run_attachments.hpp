#pragma once
// What a run file holds beside the measured readings: how the beam was aligned, what only one kind
// of test has, where a figure of the budget came from, what the uncertain time of the samples adds
// to each capture. Pure data, beside RunRecord.

#include "analysis/quantity/quantity.hpp"
#include "analysis/quantity/time.hpp"
#include "analysis/record/alignment_record.hpp"
#include "analysis/record/circular_setup.hpp"
#include "analysis/record/limit_quantity.hpp"
#include "analysis/record/probing_record.hpp"
#include "analysis/record/squareness_setup.hpp"
#include "analysis/record/straightness_setup.hpp"
#include "analysis/record/synchronisation.hpp"
#include "analysis/record/test_kind.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace axiscal {

/// A drift test: every channel read at an interval while the axis rests. The readings stand in
/// RunRecord::environment, those of the laser in vacuum wavelengths.
struct DriftSetup {
    Duration duration{}, interval{};
    Length place; ///< coordinate at which the axis rests; 0 for a ballbar, which has none
    /// Of the ballbar at rest: LaserSetup names its instrument and says nothing else.
    bool of_bar = false;

    static constexpr LimitQuantity judged_in = LimitQuantity::of_axis;
    static constexpr std::array<std::string_view, 2> judged{"E_VE", "ETVE"};
};

/// What only RunRecord::kind has, one alternative a TestKind in its order. Of a positioning run the
/// plan says all; that of a circular test comes with its first block, and nothing stands for it
/// before. `judged` of each: the figures of its kind that a limit can name; `judged_in`: what that
/// limit is.
using TestSetup = std::variant<std::monostate,
                               CircularSetup,
                               DriftSetup,
                               ProbingRecord,
                               StraightnessSetup,
                               SquarenessSetup>;
static_assert(std::variant_size_v<TestSetup> == all_test_kinds.size());

struct RunAttachments {
    std::optional<AlignmentRecord> alignment; ///< of the beam, where it was watched
    TestSetup setup;
    /// Id of the drift test that UncertaintySetup::eve comes from, of a circular test
    /// CircularUncertaintyStatement::eve_um, of a straightness or a squareness
    /// StraightnessStatement::eve or eve_angle; or empty.
    std::string eve_source;
    std::vector<SynchronisationRecord> synchronisation; ///< of datums and points, as they came
};

} // namespace axiscal
