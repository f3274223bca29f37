#include "tools/axiscal/cases/separation_reader.hpp"

#include <cmath>

namespace axiscal {

using nlohmann::json;

namespace {

Result<std::size_t> order_of(const json& value, const std::string& field) {
    AXISCAL_TRY(const double number, number_of(value, field));
    if (number < 0 || number > static_cast<double>(highest_separation_order) ||
        number != std::floor(number))
        return refuse(Fault::bad_case, field, "must be a whole number from 0 to 20");
    return static_cast<std::size_t>(number);
}

Result<PerAxis<std::size_t>> order_row(const json& array, const std::string& field) {
    if (!array.is_array() || array.size() != 3)
        return refuse(Fault::bad_case, field, "must be three orders, for x, y and z");
    PerAxis<std::size_t> row{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        AXISCAL_TRY(row[axis], order_of(array[axis], indexed(field, axis)));
    }
    return row;
}

Result<StatedOrders> chosen_orders(const json& object) {
    AXISCAL_TRY(const std::string word, one_of(object, "order", "order", {"auto"}));
    StatedOrders stated;
    AXISCAL_TRY(const double highest, number_or(object, "max_order", "max_order", 5));
    if (!(highest >= 1 && highest <= static_cast<double>(highest_chosen_order)) ||
        highest != std::floor(highest))
        return refuse(Fault::bad_case, "max_order", "must be a whole number from 1 to 6");
    stated.highest = static_cast<std::size_t>(highest);
    return stated;
}

Result<AxisRange> range_of(const json& ranges, const std::string& axis, const std::string& prefix) {
    const std::string field = prefix + "ranges_mm." + axis;
    AXISCAL_TRY(const std::vector<double> pair, numbers_at(ranges, axis, field));
    if (pair.size() != 2) return refuse(Fault::bad_case, field, "must be [from, to]");
    return AxisRange{pair[0], pair[1]};
}

} // namespace

std::string axis_letter(std::size_t axis) {
    return {static_cast<char>('x' + axis)};
}
std::string curve_name(std::size_t direction, std::size_t axis) {
    return axis_letter(direction) + axis_letter(axis);
}

Result<PerAxis<double>> triple_of(const json& array, const std::string& field) {
    AXISCAL_TRY(const std::vector<double> numbers, numbers_of(array, field));
    if (numbers.size() != 3)
        return refuse(Fault::bad_case, field, "must be three numbers, for x, y and z");
    return PerAxis<double>{numbers[0], numbers[1], numbers[2]};
}

Result<StatedOrders> orders_of(const json& object) {
    const bool is_auto = object.contains("order") && object.at("order").is_string();
    if (is_auto) return chosen_orders(object);
    if (object.contains("max_order"))
        return refuse(Fault::bad_case, "max_order", "stands only beside \"order\":\"auto\"");
    StatedOrders stated;
    const json five = 5;
    const json& order = object.contains("order") ? object.at("order") : five;
    if (!order.is_array()) {
        AXISCAL_TRY(const std::size_t of_all, order_of(order, "order"));
        for (auto& row : stated.orders)
            row.fill(of_all);
        return stated;
    }
    const bool by_row = order.size() == 3 && order[0].is_array();
    for (std::size_t direction = 0; direction < 3; ++direction) {
        AXISCAL_TRY(stated.orders[direction],
                    by_row ? order_row(order[direction], indexed("order", direction))
                           : order_row(order, "order"));
    }
    return stated;
}

Result<SeparationModel> model_of(const json& object, const std::string& prefix) {
    SeparationModel model;
    AXISCAL_TRY(const json* ranges, member(object, "ranges_mm", prefix + "ranges_mm"));
    AXISCAL_CHECK(check_object(*ranges, prefix + "ranges_mm", {"x", "y", "z"}));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        AXISCAL_TRY(model.ranges_mm[axis], range_of(*ranges, axis_letter(axis), prefix));
    }
    AXISCAL_TRY(const json* reference, member(object, "reference_mm", prefix + "reference_mm"));
    AXISCAL_TRY(model.reference_mm, triple_of(*reference, prefix + "reference_mm"));
    if (!object.contains("signs")) return model;
    const json& signs = object.at("signs");
    if (!signs.is_array() || signs.size() != 3)
        return refuse(Fault::bad_case, "signs", "must be a row for each of x, y and z");
    for (std::size_t row = 0; row < 3; ++row) {
        AXISCAL_TRY(model.signs[row], triple_of(signs[row], indexed("signs", row)));
    }
    return model;
}

nlohmann::ordered_json model_to_json(const SeparationModel& model) {
    nlohmann::ordered_json out;
    for (std::size_t axis = 0; axis < 3; ++axis)
        out["ranges_mm"][axis_letter(axis)] = {model.ranges_mm[axis].from,
                                               model.ranges_mm[axis].to};
    out["reference_mm"] = model.reference_mm;
    return out;
}

std::string convention_of(const PerCurve<double>& signs) {
    std::string text;
    for (std::size_t a = 0; a < 3; ++a) {
        text += (a == 0 ? "D" : "; D") + axis_letter(a) + " =";
        for (std::size_t b = 0; b < 3; ++b) {
            const bool minus = signs[a][b] < 0;
            text += b == 0 ? (minus ? " -" : " ") : (minus ? " - " : " + ");
            text += "d" + curve_name(a, b) + "(" + axis_letter(b) + ")";
        }
    }
    return text;
}

Result<PerCurve<std::vector<double>>> terms_of(const json& object, const std::string& field) {
    Words names;
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b)
            names.push_back(curve_name(a, b));
    AXISCAL_CHECK(check_object(object, field, names));
    PerCurve<std::vector<double>> terms;
    const std::string place_in_it = field + ".";
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b) {
            const std::string name = curve_name(a, b), place = place_in_it + name;
            if (!object.contains(name)) continue;
            AXISCAL_TRY(terms[a][b], numbers_of(object.at(name), place));
            if (terms[a][b].size() > highest_separation_order)
                return refuse(Fault::bad_case, place, "must not be longer than 20");
            for (std::size_t k = 0; k < terms[a][b].size(); ++k)
                AXISCAL_CHECK(check_number(terms[a][b][k], indexed(place, k)));
        }
    return terms;
}

} // namespace axiscal
