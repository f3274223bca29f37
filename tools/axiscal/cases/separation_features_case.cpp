#include "tools/axiscal/cases/separation_csv.hpp"
#include "tools/axiscal/cases/separation_features.hpp"
#include "tools/axiscal/cases/separation_reader.hpp"

#include <utility>

namespace axiscal {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

Result<std::size_t> axis_at(const json& object, const std::string& key, const std::string& field) {
    AXISCAL_TRY(const std::string letter, one_of(object, key, field + "." + key, {"x", "y", "z"}));
    return static_cast<std::size_t>(letter[0] - 'x');
}

Result<void>
take_positions(const json& object, const std::string& field, SingleAxisFeature& feature) {
    if (!object.contains("positions_mm")) return {};
    const json& positions = object.at("positions_mm");
    const std::string place = field + ".positions_mm", place_in_it = place + ".";
    AXISCAL_CHECK(check_object(positions, place, {"x", "y", "z"}));
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (const std::string letter = axis_letter(axis); positions.contains(letter)) {
            AXISCAL_TRY(feature.positions_mm[axis],
                        numbers_at(positions, letter, place_in_it + letter));
        }
    return {};
}

Result<NamedFeature> feature_of(const json& object, const std::string& field) {
    AXISCAL_CHECK(check_object(
        object, field,
        {"feature", "axis", "direction", "nominal_mm", "on_machine_mm", "cmm_mm", "positions_mm"}));
    NamedFeature feature;
    if (object.contains("feature")) {
        AXISCAL_TRY(feature.name, text_of(object, "feature", field + ".feature"));
    }
    AXISCAL_TRY(feature.values.axis, axis_at(object, "axis", field));
    feature.axis = feature.values.axis;
    AXISCAL_TRY(feature.values.direction, axis_at(object, "direction", field));
    for (const auto& [key, list] : {std::pair{"nominal_mm", &feature.values.nominal_mm},
                                    std::pair{"on_machine_mm", &feature.values.on_machine_mm},
                                    std::pair{"cmm_mm", &feature.values.cmm_mm}}) {
        AXISCAL_TRY(*list, numbers_at(object, key, field + "." + key));
    }
    AXISCAL_CHECK(take_positions(object, field, feature.values));
    return feature;
}

/// The moving axis of features of a table, where the table leaves it open or is to be overruled.
Result<void> take_axes(const json& list, std::vector<NamedFeature>& features) {
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string field = indexed("features", i);
        AXISCAL_CHECK(check_object(list[i], field, {"feature", "axis"}));
        AXISCAL_TRY(const std::string name, text_of(list[i], "feature", field + ".feature"));
        AXISCAL_TRY(const std::size_t axis, axis_at(list[i], "axis", field));
        bool found = false;
        for (NamedFeature& feature : features) {
            if (feature.name != name) continue;
            found = true;
            feature.axis = feature.values.axis = axis;
        }
        if (!found)
            return refuse(Fault::bad_case, field + ".feature", "does not stand in the table");
    }
    return {};
}

Result<std::vector<NamedFeature>> all_features(const json& object) {
    if (object.contains("features") && !object.at("features").is_array())
        return refuse(Fault::bad_case, "features", "must be an array");
    std::vector<NamedFeature> features;
    if (object.contains("measurements_csv")) {
        AXISCAL_TRY(const std::string csv, text_of(object, "measurements_csv", "measurements_csv"));
        AXISCAL_TRY(const auto points, read_measurements_csv(csv));
        AXISCAL_TRY(features, features_of(points));
        if (object.contains("features")) AXISCAL_CHECK(take_axes(object.at("features"), features));
        return features;
    }
    AXISCAL_TRY(const json* list, member(object, "features", "features"));
    if (list->empty()) return refuse(Fault::bad_case, "features", "is empty");
    for (std::size_t i = 0; i < list->size(); ++i) {
        AXISCAL_TRY(NamedFeature feature, feature_of((*list)[i], indexed("features", i)));
        features.push_back(std::move(feature));
    }
    return features;
}

ordered_json feature_to_json(const NamedFeature& feature, const FeatureDeviations& deviations) {
    ordered_json out;
    if (!feature.name.empty()) out["feature"] = feature.name;
    if (feature.axis) out["axis"] = axis_letter(*feature.axis);
    out["direction"] = axis_letter(feature.values.direction);
    out["nominal_mm"] = feature.values.nominal_mm;
    out["dynamic_um"] = deviations.dynamic_um;
    out["quasi_static_um"] = deviations.quasi_static_um;
    out["total_um"] = deviations.total_um;
    return out;
}

ordered_json curves_to_json(const FeatureCurves& found, const SeparationModel& model) {
    ordered_json out = model_to_json(model);
    for (const char* key : {"terms", "standard_uncertainty_um", "residual_rms_um", "readings"})
        out[key] = ordered_json::object();
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b) {
            const auto& curve = found.curves[a][b];
            if (!curve) continue;
            const std::string name = curve_name(a, b);
            out["terms"][name] = curve->coefficients_um;
            if (!curve->uncertainty_um.empty())
                out["standard_uncertainty_um"][name] = curve->uncertainty_um;
            out["residual_rms_um"][name] = curve->residual_rms_um;
            out["readings"][name] = curve->readings;
        }
    out["not_evaluated"] = found.not_evaluated;
    return out;
}

using Kind = std::vector<double> FeatureDeviations::*;

Result<ordered_json> curves_of(const std::vector<NamedFeature>& features,
                               const std::vector<FeatureDeviations>& deviations,
                               Kind kind,
                               const SeparationModel& model) {
    std::vector<SingleAxisFeature> known;
    std::vector<std::vector<double>> values;
    for (std::size_t i = 0; i < features.size(); ++i) {
        if (!features[i].axis) continue;
        known.push_back(features[i].values);
        values.push_back(deviations[i].*kind);
    }
    AXISCAL_TRY(const FeatureCurves found, solve_features(known, values, model));
    return curves_to_json(found, model);
}

/// The curves, or why there are none.
Result<void> add_fits(const json& object,
                      const std::vector<NamedFeature>& features,
                      const std::vector<FeatureDeviations>& deviations,
                      ordered_json& out) {
    ordered_json reasons = ordered_json::object();
    for (const NamedFeature& feature : features)
        if (!feature.axis)
            reasons["features." + feature.name] =
                "none or several axes move: state its axis to have it in a curve";
    if (!object.contains("ranges_mm") || !object.contains("reference_mm")) {
        const char* reason = "curves need ranges_mm and reference_mm";
        reasons["dynamic"] = reasons["quasi_static"] = reason;
        out["not_evaluated"] = reasons;
        return {};
    }
    AXISCAL_TRY(const StatedOrders orders, orders_of(object));
    if (orders.highest) return refuse(Fault::bad_case, "order", "must be stated for workpiece 1");
    AXISCAL_TRY(SeparationModel model, model_of(object));
    model.orders = orders.orders;
    out["order"] = model.orders;
    out["convention"] = convention_of(model.signs);
    AXISCAL_TRY(out["dynamic"],
                curves_of(features, deviations, &FeatureDeviations::dynamic_um, model));
    AXISCAL_TRY(out["quasi_static"],
                curves_of(features, deviations, &FeatureDeviations::quasi_static_um, model));
    out["not_evaluated"] = reasons;
    return {};
}

} // namespace

Result<ordered_json> separation_features_case(const json& object) {
    AXISCAL_CHECK(check_object(object, "",
                               {"analysis", "workpiece", "basis", "order", "signs", "ranges_mm",
                                "reference_mm", "features", "measurements_csv"}));
    AXISCAL_TRY(const auto features, all_features(object));
    ordered_json out;
    out["format"] = "axiscal.result/1";
    out["analysis"] = "error_separation";
    out["workpiece"] = 1;
    std::vector<FeatureDeviations> deviations;
    for (std::size_t i = 0; i < features.size(); ++i) {
        AXISCAL_TRY(auto found, deviations_of(features[i].values, indexed("features", i)));
        out["features"].push_back(feature_to_json(features[i], found));
        deviations.push_back(std::move(found));
    }
    AXISCAL_CHECK(add_fits(object, features, deviations, out));
    return out;
}

Result<ordered_json> separation_table_case(std::string_view csv) {
    return separation_features_case({{"analysis", "error_separation"},
                                     {"workpiece", 1},
                                     {"measurements_csv", std::string{csv}}});
}

} // namespace axiscal
