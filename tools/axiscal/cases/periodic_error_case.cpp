#include "analysis/positioning/periodic_error.hpp"
#include "tools/axiscal/cases/case_reader.hpp"
#include "tools/axiscal/cases/cases.hpp"
#include "tools/axiscal/cases/plausibility.hpp"

#include <cmath>

namespace axiscal {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

const Words& units() {
    static const Words known{"mm", "um", "m", "deg", "arcsec"};
    return known;
}

struct PeriodicCase {
    PeriodicQuestion question;
    std::string unit, position_unit;
};

Result<int> harmonics_of(const json& object) {
    AXISCAL_TRY(const double stated, number_or(object, "harmonics", "harmonics", 2));
    if (stated < 1 || stated > 50 || stated != std::floor(stated))
        return refuse(Fault::bad_case, "harmonics", "must be a whole number between 1 and 50");
    return static_cast<int>(stated);
}

Result<std::optional<PitchRange>> pitch_range_of(const json& object) {
    if (!object.contains("pitch_range")) return std::optional<PitchRange>{};
    AXISCAL_TRY(const auto ends, numbers_at(object, "pitch_range", "pitch_range"));
    if (ends.size() != 2)
        return refuse(Fault::bad_case, "pitch_range", "must be [shortest, longest]");
    return std::optional<PitchRange>{PitchRange{ends[0], ends[1]}};
}

Result<PeriodicCase> read_case(const json& object) {
    AXISCAL_CHECK(check_object(object, "",
                               {"analysis", "unit", "position_unit", "positions", "deviations",
                                "pitch", "pitch_range", "harmonics"}));
    PeriodicCase stated;
    AXISCAL_TRY(stated.unit, one_of(object, "unit", "unit", units()));
    stated.position_unit = stated.unit;
    if (object.contains("position_unit")) {
        AXISCAL_TRY(stated.position_unit,
                    one_of(object, "position_unit", "position_unit", units()));
    }
    auto& question = stated.question;
    AXISCAL_TRY(question.positions, numbers_at(object, "positions", "positions"));
    AXISCAL_TRY(question.deviations, numbers_at(object, "deviations", "deviations"));
    AXISCAL_TRY(question.harmonics, harmonics_of(object));
    if (object.contains("pitch")) {
        AXISCAL_TRY(question.pitch, number_at(object, "pitch", "pitch"));
    }
    AXISCAL_TRY(question.pitch_range, pitch_range_of(object));
    return stated;
}

ordered_json harmonic_json(const Harmonic& wave) {
    ordered_json object;
    object["order"] = wave.order;
    object["amplitude"] = wave.amplitude;
    object["phase_rad"] = wave.phase_rad;
    object["peak_to_valley"] = wave.peak_to_valley();
    return object;
}

void add_search(const PeriodicError& result, ordered_json& document) {
    if (!result.search) return;
    ordered_json& search = document["search"];
    search["pitch_range"] = {result.search->range.low, result.search->range.high};
    search["explained_share"] = result.search->explained_share;
    search["false_alarm_probability"] = result.search->false_alarm_probability;
}

ordered_json answer(const PeriodicCase& stated, const PeriodicError& result) {
    ordered_json document;
    document["format"] = "axiscal.result/1";
    document["analysis"] = "periodic_error";
    document["unit"] = stated.unit;
    document["position_unit"] = stated.position_unit;
    document["model"] = "offset + slope x + sum of amplitude cos(2 pi order x / pitch - phase)";
    document["pitch"] = result.pitch;
    document["pitch_from"] = result.search ? "found" : "stated";
    document["harmonics"] = ordered_json::array();
    for (const Harmonic& wave : result.harmonics)
        document["harmonics"].push_back(harmonic_json(wave));
    document["peak_to_valley"] = result.peak_to_valley;
    document["offset"] = result.offset;
    document["slope"] = result.slope;
    document["residual_rms"] = result.residual_rms;
    document["residual_standard_deviation"] = result.residual_standard_deviation;
    document["points_per_period"] = result.points_per_period;
    document["periods"] = result.periods;
    document["condition"] = result.condition;
    add_search(result, document);
    document["remarks"] = result.remarks;
    return document;
}

} // namespace

Result<ordered_json> periodic_error_case(const json& object) {
    AXISCAL_TRY(const PeriodicCase stated, read_case(object));
    AXISCAL_TRY(const PeriodicError result, fit_periodic_error(stated.question));
    ordered_json document = answer(stated, result);
    if (!object.contains("position_unit"))
        add_remarks(unit_remarks(stated.question.positions, stated.unit, "position_unit"),
                    document);
    return document;
}

} // namespace axiscal
