#include "acquisition/documents/squareness/squareness_remarks.hpp"

#include "acquisition/documents/straightness/across_remarks.hpp"

namespace axiscal {
namespace {

std::string remark_on_square_error(const SquarenessResult& result) {
    const SquarenessSetup& setup = result.setup();
    if (result.found.by_reversal && setup.other)
        return "The error of the square is parted from the squareness by reversal, with run " +
               setup.other->second.run_id + ", in which the square was in the other position" +
               (setup.stated.error ? "; the error that is stated of it was not used." : ".");
    if (setup.stated.error)
        return "Without reversal: the error of the square was taken out as stated; no reading of "
               "this test checks it.";
    return "Without reversal, and with no error of the square stated: the error of the square is "
           "part of the result.";
}

std::string remark_on_mirror_of_both(const SquarenessSetup& setup) {
    const std::string words = "The mirror's form is part of both slopes";
    return setup.optics.uncertainty.mirror_limit_um_per_m2
               ? words + "; its limit stands in the budget."
               : words + ", and no limit of it is stated.";
}

void remark_on_square(const SquarenessResult& result, std::vector<std::string>& remarks) {
    const SquarenessSetup& setup = result.setup();
    remarks.push_back("The line of axis " + result.first_axis() + " is that of run " +
                      setup.first.run_id + "; this run measured axis " + result.second_axis() +
                      " from the same prism and mirror, through the square.");
    remarks.push_back(remark_on_square_error(result));
    if (!setup.stated.mount_limit)
        remarks.emplace_back("By how much mirror and square may have turned against each other "
                             "between the two lines is not stated.");
    remarks.push_back(remark_on_mirror_of_both(setup));
    remarks.emplace_back("In no budget: the roll of the prism, pitch and yaw of the axes with the "
                         "distance of the optics from the functional point, and the offset between "
                         "the places of both lines.");
    remarks.emplace_back("The slope of a single line belongs to the set-up between optics and "
                         "axis; only both together tell of the machine.");
}

} // namespace

std::vector<std::string> remarks_on_squareness(const SquarenessResult& result, Duration clock_off) {
    std::vector<std::string> remarks = remarks_on_completeness(result.run, result.completeness);
    remarks.emplace_back(positions_by_the_control);
    remark_on_square(result, remarks);
    remarks.emplace_back(air_as_usual);
    remarks.emplace_back(no_expansion);
    remark_on_course(result, clock_off, remarks);
    return remarks;
}

} // namespace axiscal
