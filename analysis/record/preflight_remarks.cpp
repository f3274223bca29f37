#include "analysis/record/preflight_remarks.hpp"

namespace axiscal {

void remark_on_preflight(const std::vector<PreflightRecord>& checks,
                         std::vector<std::string>& remarks) {
    for (const PreflightRecord& check : checks)
        if (!check.passed)
            remarks.push_back("Armed although the pre-flight check \"" + check.name +
                              "\" failed: " + check.verdict +
                              " Reason given: " + check.override_reason + ".");
        else if (check.warning)
            remarks.push_back("Pre-flight check \"" + check.name + "\": " + check.verdict);
}

} // namespace axiscal
