#include "tools/axiscal/cases/separation_csv.hpp"

#include "tools/axiscal/case_text.hpp"
#include "tools/axiscal/cases/table_text.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

namespace axiscal {
namespace {

tl::unexpected<Error> refuse_line(std::size_t line, std::string reason) {
    return refuse(Fault::bad_case, "measurements_csv line " + std::to_string(line),
                  std::move(reason));
}

/// What a result can carry as text.
bool is_utf8(const std::string& text) {
    try {
        return !nlohmann::json(text).dump().empty();
    } catch (const nlohmann::json::exception&) {
        return false;
    }
}

/// Where a column's numbers go.
struct Column {
    PerAxis<std::optional<double>> MeasuredPoint::*group = nullptr;
    std::size_t axis = 0;
    std::string name;
};

std::optional<Column> column_of(const std::string& name) {
    std::string_view stem = name;
    if (stem.ends_with("_mm")) stem.remove_suffix(3);
    if (stem.size() < 3 || stem[stem.size() - 2] != '_') return std::nullopt;
    const char axis = stem.back();
    if (axis < 'x' || axis > 'z') return std::nullopt;
    stem.remove_suffix(2);
    Column column{nullptr, static_cast<std::size_t>(axis - 'x'), name};
    if (stem == "nominal") column.group = &MeasuredPoint::nominal_mm;
    if (stem == "on_machine") column.group = &MeasuredPoint::on_machine_mm;
    if (stem == "cmm") column.group = &MeasuredPoint::cmm_mm;
    return column.group ? std::optional{column} : std::nullopt;
}

Result<std::vector<Column>> columns_of(const std::vector<std::string>& header, std::size_t line) {
    std::vector<Column> columns;
    for (std::size_t i = 1; i < header.size(); ++i) {
        const auto column = column_of(header[i]);
        if (!column)
            return refuse_line(line, "'" + printable(header[i]) +
                                         "' is no column; known are nominal_, on_machine_ and "
                                         "cmm_ with x, y or z");
        for (const Column& other : columns)
            if (other.group == column->group && other.axis == column->axis)
                return refuse_line(line, column->name + " stands twice");
        columns.push_back(*column);
    }
    return columns;
}

/// Both measurements of an axis, or none; a measured one needs its nominal.
Result<void> check_point(const MeasuredPoint& point) {
    bool measured = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::string name(1, static_cast<char>('x' + axis));
        const bool on_machine = point.on_machine_mm[axis].has_value();
        if (on_machine != point.cmm_mm[axis].has_value())
            return refuse_line(point.line, std::string{on_machine ? "cmm_" : "on_machine_"} + name +
                                               " is missing beside the other measurement");
        if (on_machine && !point.nominal_mm[axis])
            return refuse_line(point.line, "nominal_" + name + " is missing");
        measured = measured || on_machine;
    }
    if (!measured) return refuse_line(point.line, "holds no measured coordinate");
    return {};
}

Result<MeasuredPoint>
point_of(const CaseTable& table, const TableRow& row, const std::vector<Column>& columns) {
    const auto& cells = row.cells;
    if (cells[0].empty()) return refuse_line(row.line, "names no feature");
    if (!is_utf8(cells[0]))
        return refuse_line(
            row.line,
            "has a feature name that is not UTF-8: save the file as UTF-8 in your editor");
    MeasuredPoint point{cells[0], row.line, {}, {}, {}};
    for (std::size_t i = 0; i < columns.size(); ++i) {
        if (cells[i + 1].empty()) continue;
        auto number = number_in_cell(cells[i + 1], table.separator, "");
        if (!number) return refuse_line(row.line, columns[i].name + ": " + number.error().detail);
        (point.*columns[i].group)[columns[i].axis] = *number;
    }
    AXISCAL_CHECK(check_point(point));
    return point;
}

using Group = std::vector<const MeasuredPoint*>;

std::vector<Group> groups_of(const std::vector<MeasuredPoint>& points) {
    std::vector<Group> groups;
    std::map<std::string, std::size_t> place;
    for (const MeasuredPoint& point : points) {
        const auto [found, added] = place.try_emplace(point.feature, groups.size());
        if (added) groups.emplace_back();
        groups[found->second].push_back(&point);
    }
    return groups;
}

/// The coordinates of a group where each point has one; else empty.
std::vector<double>
all_of(const Group& group, PerAxis<std::optional<double>> MeasuredPoint::*which, std::size_t axis) {
    std::vector<double> values;
    for (const MeasuredPoint* point : group) {
        if (!(point->*which)[axis]) return {};
        values.push_back(*(point->*which)[axis]);
    }
    return values;
}

std::optional<std::size_t> moving_axis(const PerAxis<std::vector<double>>& positions) {
    std::optional<std::size_t> moving;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto& list = positions[axis];
        if (std::ranges::all_of(list, [&](double q) { return q == list.front(); })) continue;
        if (moving) return std::nullopt;
        moving = axis;
    }
    return moving;
}

} // namespace

Result<std::vector<MeasuredPoint>> read_measurements_csv(std::string_view text) {
    AXISCAL_TRY(const std::string utf8, utf8_of(text));
    auto table = read_table_text(utf8);
    if (!table) { // "table line 7"
        Error error = std::move(table).error();
        error.field.replace(0, std::string_view{"table"}.size(), "measurements_csv");
        return tl::unexpected<Error>(std::move(error));
    }
    const auto& header = table->header.cells;
    if (header.size() < 2 || header[0] != "feature")
        return refuse_line(std::max<std::size_t>(table->header.line, 1),
                           "must be the header feature,nominal_*,on_machine_*,cmm_*");
    AXISCAL_TRY(const std::vector<Column> columns, columns_of(header, table->header.line));
    std::vector<MeasuredPoint> points;
    for (const TableRow& row : table->rows) {
        AXISCAL_TRY(MeasuredPoint point, point_of(*table, row, columns));
        points.push_back(std::move(point));
    }
    if (points.empty())
        return refuse_line(table->header.line, "is the end, and no point was stated");
    return points;
}

Result<std::vector<NamedFeature>> features_of(const std::vector<MeasuredPoint>& points) {
    std::vector<NamedFeature> features;
    for (const Group& group : groups_of(points)) {
        PerAxis<std::vector<double>> positions;
        for (std::size_t axis = 0; axis < 3; ++axis)
            positions[axis] = all_of(group, &MeasuredPoint::nominal_mm, axis);
        for (std::size_t direction = 0; direction < 3; ++direction) {
            const auto measured = [&](const MeasuredPoint* point) {
                return point->cmm_mm[direction].has_value();
            };
            if (std::ranges::none_of(group, measured)) continue;
            if (const auto gap = std::ranges::find_if_not(group, measured); gap != group.end())
                return refuse_line((*gap)->line, std::string{"lacks "} +
                                                     static_cast<char>('x' + direction) +
                                                     ", which other points of feature " +
                                                     printable((*gap)->feature) + " have");
            NamedFeature feature{group.front()->feature, moving_axis(positions), {}};
            feature.values = {feature.axis.value_or(0),
                              direction,
                              positions[direction],
                              all_of(group, &MeasuredPoint::on_machine_mm, direction),
                              all_of(group, &MeasuredPoint::cmm_mm, direction),
                              positions};
            features.push_back(std::move(feature));
        }
    }
    return features;
}

} // namespace axiscal
