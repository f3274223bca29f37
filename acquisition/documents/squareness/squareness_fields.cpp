#include "acquisition/documents/pdf/wording.hpp"
#include "acquisition/documents/squareness/squareness_pages.hpp"
#include "acquisition/documents/squareness/squareness_wording.hpp"

namespace axiscal {
namespace {

std::string stated_error_of_square(const SquareStatement& said) {
    if (!said.error && !said.error_U && !said.error_limit) return "not stated";
    std::string words = arcsec_stated(said.error);
    if (said.error_U)
        return words + ", U = " + arcsec_stated(said.error_U) + ", k = " + as_stated(said.error_k);
    if (said.error_limit) return words + " ± " + arcsec_stated(said.error_limit);
    return words + ", uncertainty not stated";
}

} // namespace

std::vector<StatedField> fields_of_square(const SquarenessResult& result) {
    const SquarenessSetup& setup = result.setup();
    const SquareStatement& said = setup.stated;
    return {{"Position", setup.square == SquarePosition::turned ? "turned" : "as at first"},
            {"Error taken out", square_error_on_paper(result)},
            {"Error as stated", stated_error_of_square(said)},
            {"Mirror against square",
             said.mount_limit ? "± " + arcsec_stated(said.mount_limit) : "not stated"},
            {"Line of the first axis", "run " + stated(setup.first.run_id)},
            {"Other position", setup.other ? "runs " + stated(setup.other->first.run_id) + ", " +
                                                 stated(setup.other->second.run_id)
                                           : "not measured"}};
}

} // namespace axiscal
