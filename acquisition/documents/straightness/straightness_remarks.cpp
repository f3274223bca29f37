#include "acquisition/documents/straightness/straightness_remarks.hpp"

#include "acquisition/documents/csv_text.hpp"
#include "acquisition/documents/straightness/across_remarks.hpp"

#include <cmath>

namespace axiscal {
namespace {

std::string remark_on_mirror(const StraightnessSetup& setup) {
    const std::string words = "The mirror's form is part of the result";
    return setup.uncertainty.mirror_limit_um_per_m2 ? words + "; its limit stands in the budget."
                                                    : words + ", and no limit of it is stated.";
}

/// Nobody may take this one for the mean of two.
std::string remark_on_turned_mirror(const StraightnessSetup& setup) {
    std::string words = "The mirror stood ";
    words += setup.mirror == MirrorPosition::reversed ? "turned by 180 degrees" : "as at first";
    if (!setup.reversal_of.empty())
        words += "; run " + setup.reversal_of + " has the other position";
    return words + ". This is the result of one position alone.";
}

/// Each run about its own line, so that no slope of it is left.
std::string remark_on_reversal(const StraightnessResult& result) {
    return "The mirror's form was parted from the motion by reversal: every mean is that of this "
           "run and of run " +
           result.setup().reversal_of +
           ", which has the mirror in the other position, each about its own least squares line. "
           "The form of the mirror: " +
           csv_number(std::round(result.mirror->straightness_um(main_reference) * 1000) / 1000) +
           " \u00B5m (least squares line).";
}

void remark_on_wollaston(const StraightnessResult& result, std::vector<std::string>& remarks) {
    const StraightnessSetup& setup = result.setup();
    remarks.push_back(result.mirror ? remark_on_reversal(result) : remark_on_mirror(setup));
    const bool turned = setup.mirror == MirrorPosition::reversed || !setup.reversal_of.empty();
    if (turned && !result.mirror) remarks.push_back(remark_on_turned_mirror(setup));
    remarks.emplace_back(air_as_usual);
    remarks.emplace_back("In no budget: the roll of the prism, which mixes in the motion in the "
                         "other plane, and pitch and yaw of the axis with the distance of the "
                         "optics from the functional point.");
}

void remark_on_method(const StraightnessResult& result, std::vector<std::string>& remarks) {
    const StraightnessSetup& setup = result.setup();
    remarks.emplace_back(positions_by_the_control);
    if (setup.method == StraightnessMethod::wollaston)
        remark_on_wollaston(result, remarks);
    else
        remarks.push_back("Straightness of the line on which a foot of " +
                          csv_number(setup.base.in(mm)) +
                          " mm stood; it is not that of the motion of the axis.");
    remarks.emplace_back(no_expansion);
}

} // namespace

std::vector<std::string> remarks_on_straightness(const StraightnessResult& result,
                                                 Duration clock_off) {
    std::vector<std::string> remarks = remarks_on_completeness(result.run, result.completeness);
    remark_on_method(result, remarks);
    remark_on_course(result, clock_off, remarks);
    return remarks;
}

} // namespace axiscal
