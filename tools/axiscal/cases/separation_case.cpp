// `error_separation`: nine curves from points where three axes took part. Workpiece 1 has a file of
// its own.

#include "tools/axiscal/cases/cases.hpp"
#include "tools/axiscal/cases/separation_answer.hpp"
#include "tools/axiscal/cases/separation_csv.hpp"
#include "tools/axiscal/cases/separation_features.hpp"
#include "tools/axiscal/cases/separation_reader.hpp"

#include <utility>

namespace axiscal {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::array<std::string_view, 3> constant_rules{"reference", "paper", "free_row"};

Result<ConstantRule> constant_of(const json& object) {
    if (!object.contains("constant")) return ConstantRule::reference;
    AXISCAL_TRY(const std::string word,
                one_of(object, "constant", "constant",
                       Words{constant_rules.begin(), constant_rules.end()}));
    return static_cast<ConstantRule>(std::ranges::find(constant_rules, word) -
                                     constant_rules.begin());
}

Result<std::vector<PerAxis<double>>> triples_at(const json& object, const std::string& key) {
    AXISCAL_TRY(const json* array, member(object, key, key));
    if (!array->is_array()) return refuse(Fault::bad_case, key, "must be an array of [x,y,z]");
    std::vector<PerAxis<double>> triples;
    for (std::size_t i = 0; i < array->size(); ++i) {
        AXISCAL_TRY(const PerAxis<double> triple, triple_of((*array)[i], indexed(key, i)));
        triples.push_back(triple);
    }
    return triples;
}

/// Points and deviations out of a table of both measurements.
Result<void> take_table(const json& object, SeparationCase& stated) {
    for (const char* key : {"points_mm", "deviation_um"})
        if (object.contains(key))
            return refuse(Fault::bad_case, key, "cannot stand beside measurements_csv");
    std::string kind = "dynamic";
    if (object.contains("deviation")) {
        AXISCAL_TRY(kind,
                    one_of(object, "deviation", "deviation", {"dynamic", "total", "quasi_static"}));
    }
    AXISCAL_TRY(const std::string text, text_of(object, "measurements_csv", "measurements_csv"));
    AXISCAL_TRY(const auto points, read_measurements_csv(text));
    for (const MeasuredPoint& point : points) {
        PerAxis<double> at{}, deviation{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!point.cmm_mm[axis])
                return refuse(Fault::bad_case,
                              "measurements_csv line " + std::to_string(point.line),
                              "needs all three coordinates, " + axis_letter(axis) + " is missing");
            const double nominal = *point.nominal_mm[axis];
            const double dynamic = 1000 * (*point.on_machine_mm[axis] - nominal);
            const double total = 1000 * (*point.cmm_mm[axis] - nominal);
            at[axis] = nominal;
            deviation[axis] = kind == "dynamic" ? dynamic
                              : kind == "total" ? total
                                                : total - dynamic;
        }
        stated.points_mm.push_back(at);
        stated.deviation_um.push_back(deviation);
    }
    return {};
}

Result<void> take_points(const json& object, SeparationCase& stated) {
    if (object.contains("measurements_csv")) return take_table(object, stated);
    if (object.contains("deviation"))
        return refuse(Fault::bad_case, "deviation", "stands only beside measurements_csv");
    AXISCAL_TRY(stated.points_mm, triples_at(object, "points_mm"));
    AXISCAL_TRY(stated.deviation_um, triples_at(object, "deviation_um"));
    return {};
}

/// Takes the stated reading at the reference out of every deviation.
Result<void> subtract_reading_at_reference(const json& object, SeparationCase& stated) {
    if (!object.contains("reference_deviation_um")) return {};
    const std::string field = "reference_deviation_um";
    AXISCAL_TRY(const PerAxis<double> reading, triple_of(object.at(field), field));
    for (auto& deviation : stated.deviation_um)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            AXISCAL_CHECK(check_number(reading[axis], indexed(field, axis)));
            deviation[axis] -= reading[axis];
        }
    return {};
}

/// Takes curves known before (workpiece 1) out of every deviation.
Result<void> subtract_quasi_static(const json& object, SeparationCase& stated) {
    if (!object.contains("quasi_static")) return {};
    const json& known = object.at("quasi_static");
    const std::string field = "quasi_static";
    AXISCAL_CHECK(check_object(known, field,
                               {"terms", "ranges_mm", "reference_mm", "standard_uncertainty_um",
                                "residual_rms_um", "readings", "not_evaluated"}));
    AXISCAL_TRY(const json* terms, member(known, "terms", "quasi_static.terms"));
    AXISCAL_TRY(const auto coefficients, terms_of(*terms, "quasi_static.terms"));
    SeparationModel model = stated.model;
    if (known.contains("ranges_mm") || known.contains("reference_mm")) {
        AXISCAL_TRY(model, model_of(known, "quasi_static."));
        model.signs = stated.model.signs;
        AXISCAL_CHECK(check_model(model));
    }
    for (std::size_t i = 0; i < stated.points_mm.size(); ++i) {
        AXISCAL_CHECK(check_point(model, stated.points_mm[i], indexed("points_mm", i)));
        const PerAxis<double> share = deviation_from(coefficients, model, stated.points_mm[i]);
        for (std::size_t axis = 0; axis < 3; ++axis)
            stated.deviation_um[i][axis] -= share[axis];
    }
    return {};
}

Result<SeparationCase> stated_separation(const json& object) {
    AXISCAL_CHECK(
        check_object(object, "",
                     {"analysis", "workpiece", "basis", "order", "max_order", "constant", "signs",
                      "ranges_mm", "reference_mm", "points_mm", "deviation_um", "measurements_csv",
                      "deviation", "quasi_static", "reference_deviation_um"}));
    SeparationCase stated;
    AXISCAL_TRY(stated.constant, constant_of(object));
    AXISCAL_TRY(stated.model, model_of(object));
    AXISCAL_CHECK(take_points(object, stated));
    AXISCAL_CHECK(check_separation(stated));
    AXISCAL_CHECK(subtract_reading_at_reference(object, stated));
    AXISCAL_CHECK(subtract_quasi_static(object, stated));
    return stated;
}

Result<ordered_json> three_axes(const json& object) {
    AXISCAL_TRY(const StatedOrders orders, orders_of(object));
    AXISCAL_TRY(SeparationCase stated, stated_separation(object));
    if (orders.highest) {
        AXISCAL_TRY(stated.model.orders, choose_orders(stated, *orders.highest));
    } else {
        stated.model.orders = orders.orders;
    }
    AXISCAL_TRY(const PerAxis<SeparatedRow> rows, separate_errors(stated));
    ordered_json out;
    out["format"] = "axiscal.result/1";
    out["analysis"] = "error_separation";
    out["workpiece"] = 2;
    out["basis"] = "chebyshev2";
    out["constant"] = constant_rules[static_cast<std::size_t>(stated.constant)];
    out["order"] = stated.model.orders;
    out["order_criterion"] = orders.highest ? "AICc" : "stated";
    out["convention"] = convention_of(stated.model.signs);
    out.update(model_to_json(stated.model));
    out["points"] = stated.points_mm.size();
    out["quasi_static_subtracted"] = object.contains("quasi_static");
    add_separation(out, rows, stated);
    return out;
}

} // namespace

Result<ordered_json> separation_case(const json& object) {
    if (object.contains("basis")) {
        AXISCAL_TRY(const std::string basis, one_of(object, "basis", "basis", {"chebyshev2"}));
    }
    AXISCAL_TRY(const double workpiece, number_or(object, "workpiece", "workpiece", 2));
    if (workpiece == 1) return separation_features_case(object);
    if (workpiece != 2) return refuse(Fault::bad_case, "workpiece", "must be 1 or 2");
    return three_axes(object);
}

} // namespace axiscal
