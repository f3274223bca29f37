#include "analysis/positioning/chosen_standards.hpp"

#include <array>
#include <optional>

namespace axiscal {
namespace {

std::string known_names() {
    std::string names;
    for (const PositioningStandard& standard : positioning_standards())
        names += (names.empty() ? "\"" : ", \"") + std::string{standard.name} + "\"";
    return names;
}

} // namespace

Result<ChosenStandards> chosen_standards(const std::vector<std::string>& names) {
    ChosenStandards chosen;
    for (const std::string& name : names) {
        const PositioningStandard* standard = find_positioning_standard(name);
        if (standard == nullptr)
            return fail(Fault::refused,
                        "the standard \"" + name + "\" is not known; known are " + known_names());
        if (standard->is_iso() && chosen.own == nullptr)
            chosen.own = standard;
        else
            chosen.others.push_back(standard);
    }
    if (chosen.own == nullptr) chosen.own = &positioning_standards().front();
    return chosen;
}

OtherResult evaluate_other(const PositioningStandard& standard, const RunAt20C& run) {
    OtherResult other{std::string{standard.name},
                      std::string{standard.confidence},
                      std::string{standard.note},
                      {},
                      {},
                      {}};
    if (standard.is_iso()) {
        const PositioningResult result =
            evaluate_positioning(run, other.standard, standard.cover_factor);
        other.parameters = named_figures(result.parameters);
        other.not_evaluated = result.not_evaluated;
        return other;
    }
    StyleResult style = evaluate_style(standard.figures, run);
    other.parameters = std::move(style.parameters);
    other.not_evaluated = std::move(style.not_evaluated);
    other.notes = std::move(style.notes);
    return other;
}

NamedFigures named_figures(const PositioningParameters& p) {
    const std::array<std::optional<double>, positioning_parameters.size()> values{
        p.A, p.A_forward, p.A_backward, p.E,          p.E_forward, p.E_backward,
        p.M, p.R,         p.R_forward,  p.R_backward, p.B,         p.B_mean};
    NamedFigures figures;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (values[i]) figures.push_back({std::string{positioning_parameters[i]}, *values[i]});
    return figures;
}

} // namespace axiscal
