#include "acquisition/documents/circular/circular_json.hpp"
#include "tools/axiscal/cases/cases.hpp"
#include "tools/axiscal/cases/circular_input.hpp"
#include "tools/axiscal/cases/plausibility.hpp"
#include "tools/axiscal/cases/tolerances_member.hpp"

namespace axiscal {

Result<nlohmann::ordered_json> circular_case(const nlohmann::json& object) {
    AXISCAL_TRY(const CircularInput input, read_circular_case(object));
    const CircularTest& test = input.test;
    AXISCAL_TRY(const CircularParameters parameters,
                evaluate_circular(test, input.f_centre, input.bar));
    AXISCAL_TRY(const CircleDiagnosis diagnosis, diagnose_circle(test, input.axes));
    std::optional<CircularBudget> budget;
    if (input.uncertainty) {
        AXISCAL_TRY(budget, circular_budget(test, input.f_centre, input.bar,
                                            input.uncertainty->stated, input.uncertainty->trials));
    }
    auto document = circular_to_json({test, input.axes, parameters, diagnosis, budget});
    if (input.tolerances) add_verdicts(*input.tolerances, document);
    add_remarks(circular_remarks(test), document);
    return document;
}

} // namespace axiscal
