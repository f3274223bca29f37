#include "tools/axiscal/cases/separation_answer.hpp"

#include "tools/axiscal/cases/separation_reader.hpp"

#include <cmath>

namespace axiscal {
namespace {

using nlohmann::ordered_json;

template <class Use> void each_curve(const PerAxis<SeparatedRow>& rows, Use use) {
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b)
            use(curve_name(a, b), rows[a].curves[b], a, b);
}

template <class Figure> ordered_json by_row(const PerAxis<SeparatedRow>& rows, Figure figure) {
    ordered_json list = ordered_json::array();
    for (const SeparatedRow& row : rows) {
        const std::optional<double> value = figure(row);
        list.push_back(value ? ordered_json(*value) : ordered_json(nullptr));
    }
    return list;
}

ordered_json counts(const PerAxis<SeparatedRow>& rows, std::size_t SeparatedRow::*which) {
    return {rows[0].*which, rows[1].*which, rows[2].*which};
}

/// Uncertainty of a curve's value: sqrt(w^T C w), w = U_k - U_k(ref).
double uncertainty_at(const SeparatedCurve& curve, const AxisRange& range, double ref, double q) {
    const std::size_t n = curve.coefficients_um.size();
    std::vector<double> here(n + 1), there(n + 1);
    second_kind(range.normalised(q), here);
    second_kind(range.normalised(ref), there);
    double variance = 0;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            variance += (here[i + 1] - there[i + 1]) * curve.covariance_um2(i, j) *
                        (here[j + 1] - there[j + 1]);
    return std::sqrt(std::max(variance, 0.0));
}

ordered_json evaluated(const SeparatedCurve& curve, const AxisRange& range, double reference) {
    constexpr int steps = 20;
    ordered_json out;
    for (int i = 0; i <= steps; ++i) {
        const double q = range.from + (range.to - range.from) * i / steps;
        out["position_mm"].push_back(q);
        out["value_um"].push_back(curve_at(curve.coefficients_um, range, reference, q));
        if (!curve.uncertainty_um.empty())
            out["standard_uncertainty_um"].push_back(uncertainty_at(curve, range, reference, q));
    }
    return out;
}

ordered_json dropped_to_json(const PerAxis<SeparatedRow>& rows, const SeparationCase& stated) {
    ordered_json list = ordered_json::array();
    for (std::size_t a = 0; a < 3; ++a)
        for (const DroppedDirection& direction : rows[a].dropped) {
            ordered_json entry;
            entry["row"] = axis_letter(a);
            entry["singular_value"] = direction.singular_value;
            entry["first_term"] = stated.constant == ConstantRule::paper ? "U_0" : "U_1";
            for (std::size_t b = 0; b < 3; ++b)
                entry["direction"][curve_name(a, b)] = direction.coefficients[b];
            if (stated.constant == ConstantRule::free_row)
                entry["direction"]["constant"] = direction.free_constant;
            list.push_back(std::move(entry));
        }
    return list;
}

void add_terms(ordered_json& out, const PerAxis<SeparatedRow>& rows, ConstantRule rule) {
    each_curve(rows, [&](const std::string& name, const SeparatedCurve& curve, auto, auto) {
        out["terms"][name] = curve.coefficients_um;
        if (rule == ConstantRule::paper) out["constants"][name] = curve.constant_um;
        if (!curve.uncertainty_um.empty())
            out["standard_uncertainty_um"][name] = curve.uncertainty_um;
    });
    if (rule == ConstantRule::free_row)
        for (std::size_t a = 0; a < 3; ++a)
            out["constants"][axis_letter(a)] = rows[a].free_constant_um;
}

void add_curves(ordered_json& out,
                const PerAxis<SeparatedRow>& rows,
                const SeparationModel& model) {
    out["not_separable"] = out["rests_on_reference"] = ordered_json::array();
    out["curves"] = ordered_json::object();
    each_curve(rows, [&](const std::string& name, const SeparatedCurve& curve, auto, auto b) {
        if (!curve.separable())
            out["not_separable"].push_back(name);
        else
            out["curves"][name] = evaluated(curve, model.ranges_mm[b], model.reference_mm[b]);
        if (curve.rests_on_reference()) out["rests_on_reference"].push_back(name);
    });
}

void add_reasons(ordered_json& out, const PerAxis<SeparatedRow>& rows) {
    ordered_json& reasons = out["not_evaluated"] = ordered_json::object();
    for (std::size_t a = 0; a < 3; ++a) {
        const std::string index = "[" + std::to_string(a) + "]";
        if (!rows[a].leave_one_out_rms_um)
            reasons["leave_one_out_rms_um" + index] =
                "a point carries a part of the fit alone: without it nothing predicts it";
        if (!rows[a].condition) reasons["condition" + index] = "the rank is 0";
        if (rows[a].curves[0].covariance_um2.columns + rows[a].curves[1].covariance_um2.columns +
                rows[a].curves[2].covariance_um2.columns ==
            0)
            reasons["standard_uncertainty_um " + axis_letter(a)] =
                "no more points than the rank: the residuals say nothing";
    }
    each_curve(rows, [&](const std::string& name, const SeparatedCurve& curve, auto, auto) {
        if (!curve.separable())
            reasons["curves." + name] =
                "these points cannot separate it from the other curves of its row; its terms are "
                "the least-norm choice, valid only in the sum of the row";
    });
}

} // namespace

void add_separation(ordered_json& out,
                    const PerAxis<SeparatedRow>& rows,
                    const SeparationCase& stated) {
    add_terms(out, rows, stated.constant);
    out["columns"] = counts(rows, &SeparatedRow::columns);
    out["rank"] = counts(rows, &SeparatedRow::rank);
    out["condition"] = by_row(rows, [](const SeparatedRow& row) { return row.condition; });
    out["residual_rms_um"] =
        by_row(rows, [](const SeparatedRow& row) { return std::optional{row.residual_rms_um}; });
    out["leave_one_out_rms_um"] =
        by_row(rows, [](const SeparatedRow& row) { return row.leave_one_out_rms_um; });
    add_curves(out, rows, stated.model);
    out["dropped_subspace"] = dropped_to_json(rows, stated);
    add_reasons(out, rows);
}

} // namespace axiscal
