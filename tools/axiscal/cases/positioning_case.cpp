#include "acquisition/publish/result_json.hpp"
#include "analysis/positioning_accuracy.hpp"
#include "tools/axiscal/cases/case_reader.hpp"
#include "tools/axiscal/cases/cases.hpp"
#include "tools/axiscal/cases/uncertainty_member.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace axiscal {
namespace {

using nlohmann::json;

struct Standard {
    std::string_view name;
    double cover_factor;
};
constexpr std::array standards{Standard{"ISO 230-2:2014", 2}, Standard{"ISO 230-2:2006", 2},
                               Standard{"ISO 230-2:1997", 2}, Standard{"ISO 230-2:1988", 3}};

void subtract_targets(DeviationTable& table) {
    for (auto* rows : {&table.forward, &table.backward})
        for (std::size_t i = 0; i < rows->size(); ++i)
            for (double& value : (*rows)[i])
                value -= table.targets[i];
}

struct Case {
    DeviationTable table;
    Standard standard;
};

Result<std::string> unit_of(const json& object) {
    AXISCAL_TRY(const json* axis, member(object, "axis", "axis"));
    if (auto good = check_object(*axis, "axis", {"name", "kind"}); !good)
        return tl::unexpected(good.error());
    AXISCAL_TRY(const std::string name, text_of(*axis, "name", "axis.name"));
    AXISCAL_TRY(const std::string kind, one_of(*axis, "kind", "axis.kind", {"linear", "rotary"}));
    return one_of(object, "unit", "unit", kind == "linear" ? Words{"mm", "um", "m"} : Words{"deg"});
}

Result<Standard> standard_of(const json& object) {
    Words names;
    for (const Standard& standard : standards)
        names.emplace_back(standard.name);
    AXISCAL_TRY(const std::string name, one_of(object, "standard", "standard", names));
    return *std::ranges::find(standards, name, &Standard::name);
}

Result<DeviationTable> table_of(const json& object) {
    DeviationTable table;
    AXISCAL_TRY(const json* targets, member(object, "targets", "targets"));
    AXISCAL_TRY(table.targets, numbers_of(*targets, "targets"));
    AXISCAL_TRY(const json* forward, member(object, "forward", "forward"));
    AXISCAL_TRY(table.forward, rows_of(*forward, "forward"));
    if (object.contains("backward")) {
        AXISCAL_TRY(table.backward, rows_of(object.at("backward"), "backward"));
    }
    return table;
}

Result<Case> case_of(const json& object) {
    const Words known{"analysis", "standard", "axis",     "unit",         "readings",
                      "targets",  "forward",  "backward", "compensation", "uncertainty"};
    if (auto good = check_object(object, "", known); !good) return tl::unexpected(good.error());
    AXISCAL_TRY(const Standard standard, standard_of(object));
    AXISCAL_TRY(std::string unit, unit_of(object));
    AXISCAL_TRY(const std::string readings,
                one_of(object, "readings", "readings", {"positions", "deviations"}));
    if (object.contains("compensation")) {
        AXISCAL_TRY(const auto stated,
                    one_of(object, "compensation", "compensation", {"already_at_20C"}));
    }
    AXISCAL_TRY(DeviationTable table, table_of(object));
    table.unit = std::move(unit);
    // positions are first checked as they came: the shape must be right and the numbers sane
    AXISCAL_TRY(const RunAt20C checked, declare_at_20C(table, "as it came"));
    if (readings == "positions") subtract_targets(table);
    return Case{std::move(table), standard};
}

} // namespace

Result<nlohmann::ordered_json> positioning_case(const json& object) {
    AXISCAL_TRY(Case stated, case_of(object));
    AXISCAL_TRY(const RunAt20C run,
                declare_at_20C(std::move(stated.table), "a case is taken as measured at 20 degC"));
    const PositioningResult result =
        evaluate_positioning(run, std::string{stated.standard.name}, stated.standard.cover_factor);
    nlohmann::ordered_json document = result_to_json(result);
    if (object.contains("uncertainty")) {
        const AxisKind kind = run.unit() == "deg" ? AxisKind::rotary : AxisKind::linear;
        AXISCAL_TRY(auto asked, uncertainty_member(object.at("uncertainty"), kind));
        AXISCAL_CHECK(add_uncertainty(document, std::move(asked), run, result));
    }
    return document;
}

} // namespace axiscal
