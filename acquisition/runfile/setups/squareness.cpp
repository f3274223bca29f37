// The set-up of a squareness test and the lines of other runs that it is evaluated with; its own
// points stand in the tables of every run.
#include "acquisition/runfile/setups/straightness_rows.hpp"
#include "analysis/record/squareness_setup.hpp"

#include <array>

namespace axiscal::squareness_rows {
namespace {

using record_readers::read_optional;
using row_values::chained;
using row_values::si_or_nothing;
using row_values::text;

/// Whose row stands in squareness_line_row: SquarenessSetup::first, OtherSquare::first, ::second.
enum class KeptLine : std::uint8_t { first, other_first, other_second };

std::string_view name_of(KeptLine line) {
    switch (line) {
    case KeptLine::first: return "first";
    case KeptLine::other_first: return "other_first";
    case KeptLine::other_second: break;
    }
    return "other_second";
}

/// run_id, axis, across, readings, scatter_m: "tttir".
void append_named_line(Row& row, const RecordedLine& line) {
    row.emplace_back(line.run_id);
    straightness_rows::append_line(row, line);
}

void read_named_line(RecordedLine& line, RowReader& in) {
    line.run_id = in.text();
    straightness_rows::read_line(line, in);
}

ChainedRow row_of_setup(const SquarenessSetup& setup) {
    Row row{text(name_of(setup.square))};
    for (Value& value : straightness_rows::row_of_optics(setup.optics))
        row.push_back(std::move(value));
    append_named_line(row, setup.first);
    return chained("squareness", std::move(row));
}

ChainedRow row_of_both_statements(const SquarenessSetup& setup) {
    const auto& [error, error_U, error_limit, error_k, mount_limit] = setup.stated;
    Row row = straightness_rows::row_of_statement(setup.optics.uncertainty);
    row.insert(row.end(), {si_or_nothing(error), si_or_nothing(error_U), si_or_nothing(error_limit),
                           error_k, si_or_nothing(mount_limit)});
    return chained("squareness_uncertainty", std::move(row));
}

ChainedRow row_of_other(const OtherSquare& other) {
    const auto& [first, second] = other;
    Row row;
    append_named_line(row, first);
    append_named_line(row, second);
    return chained("squareness_other", std::move(row));
}

void append_rows_of(std::vector<ChainedRow>& all, KeptLine which, const RecordedLine& line) {
    for (const RecordedLineRow& at : line.rows) {
        Row row{text(name_of(which))};
        straightness_rows::append_line_row(row, at);
        all.push_back(chained("squareness_line_row", std::move(row)));
    }
}

std::vector<ChainedRow> rows(const TestSetup& setup) {
    const auto& squareness = std::get<SquarenessSetup>(setup);
    const auto& [optics, first, square, stated, other] = squareness;
    std::vector<ChainedRow> all{row_of_setup(squareness), row_of_both_statements(squareness)};
    append_rows_of(all, KeptLine::first, first);
    if (!other) return all;
    all.push_back(row_of_other(*other));
    append_rows_of(all, KeptLine::other_first, other->first);
    append_rows_of(all, KeptLine::other_second, other->second);
    return all;
}

void read_setup(RecordedRun& run, RowReader& in) {
    auto& setup = only_setup_of<SquarenessSetup>(run, in);
    setup.square = in.choice({SquarePosition::normal, SquarePosition::turned});
    straightness_rows::read_optics(setup.optics, in);
    read_named_line(setup.first, in);
}

void read_both_statements(RecordedRun& run, RowReader& in) {
    auto& setup = setup_of<SquarenessSetup>(run, in);
    setup.optics.uncertainty = straightness_rows::read_optics_statement(in);
    SquareStatement stated;
    read_optional(stated.error, in);
    read_optional(stated.error_U, in);
    read_optional(stated.error_limit, in);
    stated.error_k = in.real();
    read_optional(stated.mount_limit, in);
    setup.stated = stated;
}

void read_other(RecordedRun& run, RowReader& in) {
    auto& setup = setup_of<SquarenessSetup>(run, in);
    if (setup.other) return in.reject("stands there twice");
    OtherSquare& other = setup.other.emplace();
    read_named_line(other.first, in);
    read_named_line(other.second, in);
}

/// Nothing where its head was not read.
RecordedLine* kept_line(SquarenessSetup& setup, KeptLine which) {
    if (which == KeptLine::first) return &setup.first;
    if (!setup.other) return nullptr;
    return which == KeptLine::other_first ? &setup.other->first : &setup.other->second;
}

void read_kept_row(RecordedRun& run, RowReader& in) {
    const auto which = in.choice({KeptLine::first, KeptLine::other_first, KeptLine::other_second});
    const RecordedLineRow at = straightness_rows::read_line_row(in);
    const bool alone = straightness_rows::stands_alone(run);
    RecordedLine* line = kept_line(setup_of<SquarenessSetup>(run, in), which);
    if (line != nullptr) return line->rows.push_back(at);
    if (!alone) in.reject("stands there without the line that it belongs to");
}

constexpr std::array all_tables{
    DescribedTable{
        Table{"squareness",
              "square, method, across, sign, factor, resolution_m, mirror, reversal_of, base_m, "
              "angle_resolution_rad, place, first_run_id, first_axis, first_across, "
              "first_readings, first_scatter_m",
              "tttirrttrrttttir"},
        read_setup},
    DescribedTable{
        Table{"squareness_uncertainty",
              "factor_U, factor_limit, factor_k, mirror_limit_um_per_m2, angle_U_rad, angle_k, "
              "base_U_m, base_k, eve_m, eve_rad, error_rad, error_U_rad, error_limit_rad, error_k, "
              "mount_limit_rad",
              "RRrRRrRrRRRRRrR"},
        read_both_statements},
    DescribedTable{
        Table{"squareness_other",
              "first_run_id, first_axis, first_across, first_readings, first_scatter_m, "
              "second_run_id, second_axis, second_across, second_readings, second_scatter_m",
              "tttirtttir"},
        read_other},
    DescribedTable{Table{"squareness_line_row", "line, target_m, forward_m, backward_m", "trrR"},
                   read_kept_row},
};

} // namespace
} // namespace axiscal::squareness_rows

namespace axiscal {

extern const SetupRows squareness_setup_rows{TestKind::squareness, squareness_rows::all_tables,
                                             squareness_rows::rows};

} // namespace axiscal
