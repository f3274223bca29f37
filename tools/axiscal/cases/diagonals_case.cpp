#include "acquisition/documents/positioning/result_json.hpp"
#include "analysis/geometry/diagonals.hpp"
#include "analysis/geometry/step_diagonal.hpp"
#include "tools/axiscal/cases/case_reader.hpp"
#include "tools/axiscal/cases/cases.hpp"
#include "tools/axiscal/cases/line_reader.hpp"

#include <algorithm>
#include <utility>

namespace axiscal {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::array<const char*, 3> axis_names{"x", "y", "z"};
constexpr std::array<const char*, 3> plane_names{"xy", "xz", "yz"};

Result<Box> box_of(const json& object) {
    AXISCAL_TRY(const json* sides, member(object, "box", "box"));
    AXISCAL_CHECK(check_object(*sides, "box", {"x", "y", "z"}));
    Box box{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::string key = axis_names[axis];
        AXISCAL_TRY(box[axis], number_at(*sides, key, "box." + key));
    }
    return box;
}

Result<std::array<int, 3>> signs_of(const json& object, const std::string& prefix) {
    const std::string field = prefix + "signs";
    AXISCAL_TRY(const auto numbers, numbers_at(object, "signs", field));
    std::array<int, 3> signs{};
    if (numbers.size() != 3) return refuse(Fault::bad_case, field, "must be three of -1, 0, 1");
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (numbers[axis] != -1 && numbers[axis] != 0 && numbers[axis] != 1)
            return refuse(Fault::bad_case, field, "must be three of -1, 0, 1");
        signs[axis] = static_cast<int>(numbers[axis]);
    }
    return signs;
}

Result<const json*> diagonal_array(const json& object) {
    AXISCAL_TRY(const json* array, member(object, "diagonals", "diagonals"));
    if (!array->is_array() || array->empty())
        return refuse(Fault::bad_case, "diagonals", "must be an array of diagonals");
    return array;
}

// ---- displacement ---------------------------------------------------------------------------

Result<DiagonalRun> run_of(const json& object, std::size_t index, const std::string& unit) {
    const std::string field = indexed("diagonals", index), prefix = field + ".";
    AXISCAL_CHECK(
        check_object(object, field, {"signs", "targets", "deviations", "forward", "backward"}));
    DiagonalRun run;
    AXISCAL_TRY(run.signs, signs_of(object, prefix));
    AXISCAL_TRY(auto targets, numbers_at(object, "targets", prefix + "targets"));
    AXISCAL_TRY(run.table, read_table(object, prefix, "deviations", std::move(targets)));
    run.table.unit = unit;
    return run;
}

ordered_json machine_json(const DiagonalMachine& machine) {
    ordered_json object;
    object["E_d"] = machine.E_d;
    if (machine.B_d) object["B_d"] = *machine.B_d;
    if (machine.R_d) object["R_d"] = *machine.R_d;
    object["slope_spread"] = machine.slope_spread;
    return object;
}

ordered_json squareness_json(const DiagonalSquareness& found) {
    return {{"squareness_rad", found.squareness_rad}, {"common_scale", found.common_scale}};
}

ordered_json diagonal_json(const DiagonalResult& found) {
    const ordered_json full = result_to_json(found.positioning);
    ordered_json object;
    object["signs"] = found.signs;
    object["length"] = found.length;
    object["length_error"] = found.length_error;
    object["slope_least_squares"] = found.slope_least_squares;
    object["slope_end_points"] = found.slope_end_points;
    for (const char* key : {"parameters", "positions", "not_evaluated"})
        if (full.contains(key)) object[key] = full.at(key);
    return object;
}

/// What the standard asks of a diagonal test and the data do not show.
std::vector<std::string> remarks_on(const Diagonals& found, double unit_m) {
    bool few_approaches = false, few_targets = false;
    for (const DiagonalResult& single : found.diagonals) {
        const auto count = static_cast<double>(single.positioning.positions.size());
        few_approaches = few_approaches || single.positioning.approaches < 5;
        few_targets = few_targets || count < 5 * single.length * unit_m;
    }
    std::vector<std::string> remarks;
    if (few_approaches) remarks.emplace_back("fewer than five approaches in a direction");
    if (few_targets) remarks.emplace_back("fewer than five targets a metre");
    return remarks;
}

Result<ordered_json> displacement_diagonals(const json& object) {
    AXISCAL_CHECK(check_object(object, "", {"analysis", "kind", "unit", "box", "diagonals"}));
    AXISCAL_TRY(const std::string unit, one_of(object, "unit", "unit", {"mm", "um", "m"}));
    AXISCAL_TRY(const Box box, box_of(object));
    AXISCAL_TRY(const json* array, diagonal_array(object));
    std::vector<DiagonalRun> runs;
    for (std::size_t i = 0; i < array->size(); ++i) {
        AXISCAL_TRY(DiagonalRun run, run_of((*array)[i], i, unit));
        runs.push_back(std::move(run));
    }
    AXISCAL_TRY(const Diagonals found, evaluate_diagonals(box, std::move(runs)));
    ordered_json answer;
    answer["format"] = "axiscal.result/1";
    answer["standard"] = "ISO 230-6:2002";
    answer["unit"] = unit;
    if (found.body) answer["body"] = machine_json(*found.body);
    if (found.faces) answer["faces"] = machine_json(*found.faces);
    if (found.from_body) answer["from_body_diagonals"] = squareness_json(*found.from_body);
    for (const auto& [plane, squareness] : found.from_faces)
        answer["from_face_diagonals"][plane] = squareness_json(squareness);
    answer["sign"] = "squareness > 0: the angle between the + directions exceeds 90 deg";
    answer["model"] = "reconstructed: rigid, straight, first order";
    for (const DiagonalResult& single : found.diagonals)
        answer["diagonals"].push_back(diagonal_json(single));
    if (const auto remarks = remarks_on(found, length_unit_m(unit)); !remarks.empty())
        answer["remarks"] = remarks;
    if (!found.not_evaluated.empty()) answer["not_evaluated"] = found.not_evaluated;
    return answer;
}

// ---- step diagonal ----------------------------------------------------------------------------

Result<std::array<std::size_t, 3>> order_of(const json& object) {
    if (!object.contains("order")) return std::array<std::size_t, 3>{0, 1, 2};
    AXISCAL_TRY(const std::string word,
                one_of(object, "order", "order", {"xyz", "xzy", "yxz", "yzx", "zxy", "zyx"}));
    std::array<std::size_t, 3> order{};
    std::ranges::transform(word, order.begin(),
                           [](char axis) { return static_cast<std::size_t>(axis - 'x'); });
    return order;
}

ordered_json step_json(const Box& box, const StepDiagonal& found) {
    ordered_json answer;
    answer["steps"] = found.steps;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        ordered_json moving;
        for (std::size_t node = 0; node <= found.steps; ++node)
            moving["positions"].push_back(box[axis] * static_cast<double>(node) /
                                          static_cast<double>(found.steps));
        for (std::size_t direction = 0; direction < 3; ++direction)
            moving[axis_names[direction]] = found.error[direction][axis];
        moving["closure"] = found.closure[axis];
        answer["moving"][axis_names[axis]] = std::move(moving);
    }
    for (std::size_t plane = 0; plane < 3; ++plane)
        answer["squareness_rad"][plane_names[plane]] = found.squareness_rad[plane];
    answer["assumptions"] = step_diagonal_assumptions();
    return answer;
}

Result<ordered_json> step_diagonals(const json& object) {
    AXISCAL_CHECK(
        check_object(object, "", {"analysis", "kind", "unit", "box", "order", "diagonals"}));
    AXISCAL_TRY(const std::string unit, one_of(object, "unit", "unit", {"mm", "um", "m"}));
    AXISCAL_TRY(const Box box, box_of(object));
    AXISCAL_TRY(const auto order, order_of(object));
    AXISCAL_TRY(const json* array, diagonal_array(object));
    std::vector<StepDiagonalRun> runs;
    for (std::size_t i = 0; i < array->size(); ++i) {
        const std::string field = indexed("diagonals", i), prefix = field + ".";
        AXISCAL_CHECK(check_object((*array)[i], field, {"signs", "deviations"}));
        StepDiagonalRun run;
        AXISCAL_TRY(run.signs, signs_of((*array)[i], prefix));
        AXISCAL_TRY(run.deviations, numbers_at((*array)[i], "deviations", prefix + "deviations"));
        runs.push_back(std::move(run));
    }
    AXISCAL_TRY(const StepDiagonal found, evaluate_step_diagonal(box, order, runs));
    ordered_json answer;
    answer["format"] = "axiscal.result/1";
    answer["kind"] = "step";
    answer["unit"] = unit;
    answer.update(step_json(box, found));
    return answer;
}

} // namespace

Result<ordered_json> diagonals_case(const json& object) {
    std::string kind = "displacement";
    if (object.contains("kind")) {
        AXISCAL_TRY(kind, one_of(object, "kind", "kind", {"displacement", "step"}));
    }
    return kind == "step" ? step_diagonals(object) : displacement_diagonals(object);
}

} // namespace axiscal
