#include "acquisition/preflight/preflight.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/preflight/preflight_checks.hpp"
#include "analysis/drift/settling.hpp"

#include "config/measure.hpp"

#include <algorithm>

namespace axiscal {
namespace preflight_checks {

std::string in_minutes(Duration span) {
    return span < std::chrono::minutes{2} ? in_seconds(span)
                                          : plain_number(seconds_of(span) / 60, 1) + " min";
}

void join(std::string& list, const std::string& item) {
    list += (list.empty() ? "" : "; ") + item;
}

std::string length_word_of(const PreflightFacts& facts) {
    if (facts.circular) return "ballbar";
    return facts.config.axis.scale ? "scale" : "laser";
}

double slope_of(const DriftSeries& series) {
    const auto slopes = window_slopes(series, series.times.back() - series.times.front());
    return slopes.empty() ? 0 : slopes.back().slope;
}

} // namespace preflight_checks

std::vector<PreflightRecord> judge_preflight(const PreflightFacts& facts) {
    using namespace preflight_checks;
    std::vector<PreflightRecord> checks{
        check_instruments(facts), check_soak(facts),         check_sensors(facts),
        check_contact(facts),     check_strength(facts),     check_drift(facts),
        check_expansion(facts),   check_compensation(facts), check_certificates(facts),
        check_environment(facts), check_computer(facts),     check_clock(facts)};
    if (facts.config.axis.angle && !facts.circular) checks.push_back(check_run_out(facts));
    if (states_no_dead_path(facts)) checks.push_back(doubt_dead_path());
    if (facts.eve) checks.push_back(check_eve(*facts.eve));
    return checks;
}

Result<void> override_checks(std::vector<PreflightRecord>& checks,
                             const std::map<std::string, std::string>& reasons) {
    for (const auto& [name, reason] : reasons) {
        const auto check = std::ranges::find(checks, name, &PreflightRecord::name);
        if (check == checks.end()) {
            std::string known;
            std::vector<std::string> names;
            for (const PreflightRecord& known_check : checks) {
                known += (known.empty() ? "" : ", ") + known_check.name;
                names.push_back(known_check.name);
            }
            return refuse(Fault::bad_request, "overrides." + name,
                          "is no check; there are " + known + did_you_mean(name, names));
        }
        if (reason.find_first_not_of(" \t") == std::string::npos)
            return refuse(Fault::bad_request, "overrides." + name, "needs a reason: it is printed");
        if (!check->passed) check->override_reason = reason;
    }
    return {};
}

std::string open_objections(const std::vector<PreflightRecord>& checks) {
    std::string text;
    for (const PreflightRecord& check : checks)
        if (!check.passed && check.override_reason.empty())
            text += (text.empty() ? "" : " ") + check.name + ": " + check.verdict;
    return text;
}

} // namespace axiscal
