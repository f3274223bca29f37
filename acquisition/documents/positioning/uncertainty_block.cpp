// The uncertainty budget as a reader checks it: what is stated, what each term gives, how the terms
// combine for each parameter. Micrometres; seconds of arc of a rotary axis.

#include "acquisition/documents/positioning/certificate_pages.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

/// "0.7 µm/m" or "0.5 µm" as it was stated.
std::string words_of(const DeviceLimit& limit) {
    std::string words;
    if (limit.fixed) words = as_stated(limit.fixed->in(um)) + " µm";
    if (limit.per_length)
        words += (words.empty() ? "" : " + ") + as_stated(limit.per_length->in(ppm)) + " µm/m · L";
    return words;
}

std::string stated_device(const UncertaintySetup& setup, const UncertaintyStatement& s) {
    const bool stated_here = setup.device_U.stated() || setup.device_width.stated();
    if (!stated_here)
        return "U = " + fixed(s.device_U.value_or(0), 3) +
               " µm, k = " + as_stated(s.device_k.value_or(2)) +
               ", of the instruments' certificates";
    if (setup.device_U.stated())
        return "U_cal = " + words_of(setup.device_U) + ", k = " + as_stated(setup.device_k);
    return "R_D = " + words_of(setup.device_width);
}

std::string stated_misalignment(const UncertaintySetup& setup) {
    if (setup.misalignment) return "e = " + as_stated(setup.misalignment->in(mm)) + " mm over L";
    if (!setup.misalignment_angle) return {};
    return "δ = " + as_stated(setup.misalignment_angle->in(radian)*1e3) + " mrad";
}

std::string temperature_text(const UncertaintySetup& setup, const UncertaintyStatement& s) {
    const double width_K = s.temperature_width_K.value_or(0);
    return "α = " + as_stated(s.alpha_um_per_m_K.value_or(0)) + " µm/(m·K), R(θ) = " +
           (setup.temperature_width ? as_stated(width_K) : fixed(width_K, 3)) + " K";
}

std::string expansion_text(const UncertaintyStatement& s) {
    return "ΔT = " + fixed(s.temperature_offset_K.value_or(0), 2) +
           " K, R(α) = " + fixed(s.alpha_width_um_per_m_K.value_or(0), 2) + " µm/(m·K)";
}

std::string unit_of(const Certificate& certificate) {
    return certificate.run.rotary ? "″" : "µm";
}

/// What a rotary axis has in the place of U of a length.
std::string angle_device_text(const UncertaintySetup& setup) {
    if (setup.device_U.fixed)
        return "U_cal = " + as_stated(arcsec_of(*setup.device_U.fixed)) +
               "″, k = " + as_stated(setup.device_k);
    if (setup.device_width.fixed)
        return "R_D = " + as_stated(arcsec_of(*setup.device_width.fixed)) + "″";
    return {};
}

struct TermLine {
    UncertaintyTerm term;
    const char* name;
    std::string stated;
};

/// Of a scale that measured the axis, which is as warm as it is.
void add_terms_of_scale(std::vector<TermLine>& lines, const UncertaintyStatement& s) {
    using enum UncertaintyTerm;
    lines[0].name = "Scale u_D";
    lines[1].name = "Misalignment of the scale u_MIS";
    lines.push_back(
        {device_temperature, "Temperature of the scale u_M,D",
         "α_D = " + as_stated(s.device_alpha_um_per_m_K.value_or(0)) +
             " µm/(m·K), R(θ_D) = " + fixed(s.device_temperature_width_K.value_or(0), 3) + " K"});
    lines.push_back({device_expansion, "Expansion of the scale u_E,D",
                     "ΔT_D = " + fixed(s.device_temperature_offset_K.value_or(0), 2) +
                         " K, R(α_D) = " + fixed(s.device_alpha_width_um_per_m_K.value_or(0), 2) +
                         " µm/(m·K)"});
}

std::vector<TermLine> term_lines(const Certificate& certificate) {
    const UncertaintySetup& setup = *certificate.run.uncertainty;
    const UncertaintyStatement& s = certificate.uncertainty.statement;
    using enum UncertaintyTerm;
    if (certificate.run.rotary)
        return {{device, "Instrument, artefact and set-up u_D", angle_device_text(setup)},
                {environment, "Environment u_EVE", "E_VE = " + as_stated(s.eve.value_or(0)) + "″"}};
    std::vector<TermLine> lines{
        {device, "Laser system u_D", stated_device(setup, s)},
        {misalignment, "Misalignment of the beam u_MIS", stated_misalignment(setup)},
        {machine_temperature, "Temperature of the material u_M,M", temperature_text(setup, s)},
        {machine_expansion, "Expansion coefficient u_E,M", expansion_text(s)},
        {environment, "Environment u_EVE", "E_VE = " + as_stated(s.eve.value_or(0)) + " µm"}};
    if (certificate.run.scale) add_terms_of_scale(lines, s);
    return lines;
}

void draw_terms(Sheet& sheet, const Certificate& certificate) {
    std::vector<TableRow> rows;
    for (const TermLine& line : term_lines(certificate)) {
        const Contribution* known = certificate.uncertainty.budget->find(line.term);
        if (known)
            rows.push_back({line.name, line.stated, uncertainty_on_paper(known->u),
                            formula_on_paper(known->formula), footnote_sign(known->status)});
        else
            rows.push_back({line.name, "not stated", "–", "–", "–"});
    }
    sheet.table({{"Term", "", Align::left},
                 {"Stated, or of the run", "", Align::left, true},
                 {"u", unit_of(certificate)},
                 {"Formula", "", Align::left},
                 {"Note", "", Align::left}},
                rows);
}

struct ParameterGroup {
    std::string symbols, simulated; ///< simulated u, one a symbol in their order
    const ParameterUncertainty* figure = nullptr;
    std::optional<double> target_um;
};

std::string simulated_u(const Certificate& certificate, const std::string& key) {
    const auto& simulation = certificate.uncertainty.simulation;
    const MonteCarloFigure* drawn = simulation ? simulation->find(key) : nullptr;
    return drawn ? uncertainty_on_paper(drawn->u * budget_units_per(certificate.result.unit)) : "–";
}

/// Evaluated parameters; neighbours of one budget and one target share a line.
std::vector<ParameterGroup> parameter_groups(const Certificate& certificate) {
    std::vector<ParameterLine> lines = parameters_of_both_directions(certificate.result.parameters);
    const auto one_way = parameters_of_one_direction(certificate.result.parameters);
    lines.insert(lines.end(), one_way.begin(), one_way.end());
    std::vector<ParameterGroup> groups;
    for (const ParameterUncertainty& figure : certificate.uncertainty.budget->parameters) {
        const auto line = std::ranges::find(lines, figure.key, &ParameterLine::key);
        if (line == lines.end() || !line->value) continue;
        const TargetUncertainty* target = target_uncertainty_of(certificate.run, figure.key);
        const auto target_um =
            target ? std::optional{in_budget_units(certificate.run, target->limit)} : std::nullopt;
        const bool same = !groups.empty() && groups.back().figure->u == figure.u &&
                          groups.back().figure->formula == figure.formula &&
                          groups.back().target_um == target_um;
        const std::string simulated = simulated_u(certificate, figure.key);
        if (same) {
            groups.back().symbols += ", " + std::string{line->symbol};
            groups.back().simulated += ", " + simulated;
        } else {
            groups.push_back({std::string{line->symbol}, simulated, &figure, target_um});
        }
    }
    return groups;
}

void draw_parameter_uncertainties(Sheet& sheet, const Certificate& certificate) {
    const auto groups = parameter_groups(certificate);
    if (groups.empty()) return;
    const bool targets = std::ranges::any_of(
        groups, [](const ParameterGroup& group) { return group.target_um.has_value(); });
    std::vector<TableColumn> columns{
        {"Parameter", "", Align::left},
        {"u by formula", unit_of(certificate)},
        {"u simulated", unit_of(certificate)},
        {"U = " + fixed(certificate.uncertainty.budget->coverage, 0) + " u", unit_of(certificate)}};
    if (targets) {
        columns.push_back({"U_T", unit_of(certificate)});
        columns.push_back({"U ≤ U_T", "", Align::left});
    }
    columns.push_back({"Combined as", "", Align::left, true});
    columns.push_back({"Note", "", Align::left});
    std::vector<TableRow> rows;
    for (const ParameterGroup& group : groups) {
        const ParameterUncertainty& figure = *group.figure;
        TableRow row{group.symbols, uncertainty_on_paper(figure.u), group.simulated,
                     uncertainty_on_paper(figure.expanded)};
        if (targets) {
            row.push_back(group.target_um ? uncertainty_on_paper(*group.target_um) : "–");
            const bool met = group.target_um && figure.expanded <= *group.target_um;
            row.emplace_back(!group.target_um ? "no target" : met ? "yes" : "NO");
        }
        row.push_back(formula_on_paper(figure.formula));
        row.push_back(footnote_sign(figure.status));
        rows.push_back(std::move(row));
    }
    sheet.table(columns, rows);
}

void draw_legend(Sheet& sheet, const Certificate& certificate) {
    const UncertaintyBudget& budget = *certificate.uncertainty.budget;
    const ParameterUncertainty* both = budget.find("R");
    std::string words =
        "u: standard uncertainty; a full width R(…) and E_VE are those of rectangular "
        "distributions (JCGM 100, 4.3.7), combined as the root of the sum of squares (JCGM 100, "
        "5.1.2). U is rounded up on page 1.";
    if (has_footnote_sign(budget.contributions) || has_footnote_sign(budget.parameters))
        words += " " + std::string{footnote_of_derived};
    if (both && both->strict_u)
        words +=
            " u(R) of the source counts the repeatability of both directions as common; strict "
            "propagation would give " +
            uncertainty_on_paper(*both->strict_u) + " " + unit_of(certificate) + ".";
    sheet.text(words, note_style);
}

/// What "u simulated" is, and by how much the formula of u(R) lies beside it.
void draw_simulation(Sheet& sheet, const Certificate& certificate) {
    const RunUncertainty& known = certificate.uncertainty;
    if (!known.simulation) return;
    std::string words = "Simulated: the whole evaluation of " +
                        std::to_string(known.simulation->trials) +
                        " sessions drawn about this one with the same statements (JCGM 101, seed " +
                        std::to_string(known.simulation->seed) +
                        "). Terms that grow with the length count by the distance of the targets, "
                        "extremes by the targets that may become one.";
    const auto ratio = conservatism_of_repeatability(*known.budget, *known.simulation,
                                                     budget_units_per(certificate.result.unit));
    if (ratio)
        words += " u(R) by the source's formula is " + fixed(std::fabs(*ratio - 1) * 100, 0) +
                 " % " + (*ratio >= 1 ? "above" : "below") + " the simulated one.";
    if (scatters_less_than_stated(certificate.result.parameters.R, *known.simulation))
        words += " The readings scatter less than the stated E_VE allows: look at E_VE.";
    sheet.text(words, note_style);
}

/// What the intervals of the true figures take into account, of this run.
std::string ground_of_true_figures(const Certificate& certificate) {
    std::string words;
    if (!certificate.run.rotary)
        words += "Errors that grow with the length count by the distance of the targets. ";
    if (!certificate.run.rotary && !certificate.run.scale)
        words += "A beam off the axis can only read short. ";
    return words + "The environment drifts through the run as it did in a drift test of range "
                   "E_VE; what that adds to a figure is taken off.";
}

/// Where the truth lies, in 95 of 100 runs that are measured and stated like this one.
void draw_true_figures(Sheet& sheet, const Certificate& certificate) {
    const auto& found = certificate.uncertainty.true_figures;
    if (!found) return;
    std::vector<ParameterLine> lines = parameters_of_both_directions(certificate.result.parameters);
    const auto one_way = parameters_of_one_direction(certificate.result.parameters);
    lines.insert(lines.end(), one_way.begin(), one_way.end());
    const double factor = budget_units_per(certificate.result.unit);
    std::string words;
    for (const ParameterLine& line : lines)
        if (const TrueFigure* figure = found->find(line.key))
            words += (words.empty() ? "" : "; ") + std::string{line.symbol} + " from " +
                     uncertainty_on_paper(figure->interval.low * factor) + " to " +
                     uncertainty_on_paper(figure->interval.high * factor);
    if (words.empty()) return;
    sheet.text("The true figures lie, with a probability of 95 %, in " + unit_of(certificate) +
                   ": " + words + ". " + ground_of_true_figures(certificate) + " " +
                   std::to_string(found->trials) + " sessions.",
               note_style);
}

} // namespace

void draw_uncertainty(Sheet& sheet, const Certificate& certificate) {
    const RunUncertainty& known = certificate.uncertainty;
    sheet.heading("Measurement uncertainty", known.budget ? 150 : 30);
    if (!known.budget) {
        std::string missing;
        for (const MissingTerm& term : known.missing)
            missing += (missing.empty() ? "" : "; ") + term.words;
        sheet.text("Not evaluated: the budget lacks " + missing + ".", {7.5});
        return;
    }
    // Annex A is written for linear axes; annex B is the step cycle.
    const std::string source =
        certificate.run.rotary
            ? std::string{"Budget of a rotary axis, device and environment, after ISO 230-2, "
                          "annex A"}
            : "Budget of ISO 230-2, annex A, over the span of the targets L = " +
                  fixed(known.statement.length_m.value_or(0) * 1e3, 3) + " mm";
    sheet.text(source + "; n = " + std::to_string(known.budget->approaches) +
                   ", m = " + std::to_string(certificate.deviations.targets().size()) +
                   " targets; u_EVE counts in a mean of n readings by the model \"" +
                   std::string{name_of(known.budget->eve_model)} + "\".",
               {7.5});
    draw_terms(sheet, certificate);
    draw_parameter_uncertainties(sheet, certificate);
    draw_legend(sheet, certificate);
    draw_simulation(sheet, certificate);
    draw_true_figures(sheet, certificate);
}

} // namespace axiscal
