#pragma once
// Rows that a straightness and what is evaluated with it share: the optics, what is stated of them,
// the lines that are kept of other runs. Internal to setups/. Pure.

#include "acquisition/runfile/row_values.hpp"
#include "acquisition/runfile/setups/setup_rows.hpp"
#include "analysis/record/recorded_line.hpp"
#include "analysis/record/straightness_setup.hpp"

#include <variant>

namespace axiscal::straightness_rows {

/// method, across, sign, factor, resolution_m, mirror, reversal_of, base_m, angle_resolution_rad,
/// place: "ttirrttrrt".
inline Row row_of_optics(const StraightnessSetup& setup) {
    const auto& [method, across, sign, factor, resolution, mirror, reversal_of, reversal, base,
                 angle_resolution, place, uncertainty] = setup;
    return {row_values::text(name_of(method)),
            across,
            row_values::whole(sign),
            factor,
            resolution.si(),
            row_values::text(name_of(mirror)),
            reversal_of,
            base.si(),
            angle_resolution.si(),
            place};
}

inline void read_optics(StraightnessSetup& setup, RowReader& in) {
    setup.method = in.choice({StraightnessMethod::wollaston, StraightnessMethod::angle_steps});
    setup.across = in.text();
    setup.sign = in.number<int>();
    setup.factor = in.real();
    setup.resolution = in.length();
    setup.mirror = in.choice({MirrorPosition::normal, MirrorPosition::reversed});
    setup.reversal_of = in.text();
    setup.base = in.length();
    setup.angle_resolution = Angle::from_si(in.real());
    setup.place = in.text();
}

/// factor_U, factor_limit, factor_k, mirror_limit_um_per_m2, angle_U_rad, angle_k, base_U_m,
/// base_k, eve_m, eve_rad: "RRrRRrRrRR".
inline Row row_of_statement(const StraightnessStatement& statement) {
    using row_values::si_or_nothing;
    const auto& [factor_U, factor_limit, factor_k, mirror_limit, angle_U, angle_k, base_U, base_k,
                 eve, eve_angle] = statement;
    return {si_or_nothing(factor_U),
            si_or_nothing(factor_limit),
            factor_k,
            row_values::optional(mirror_limit),
            si_or_nothing(angle_U),
            angle_k,
            si_or_nothing(base_U),
            base_k,
            si_or_nothing(eve),
            si_or_nothing(eve_angle)};
}

inline StraightnessStatement read_optics_statement(RowReader& in) {
    using record_readers::read_optional;
    StraightnessStatement statement;
    read_optional(statement.factor_U, in);
    read_optional(statement.factor_limit, in);
    statement.factor_k = in.real();
    statement.mirror_limit_um_per_m2 = in.optional_real();
    read_optional(statement.angle_U, in);
    statement.angle_k = in.real();
    read_optional(statement.base_U, in);
    statement.base_k = in.real();
    read_optional(statement.eve, in);
    read_optional(statement.eve_angle, in);
    return statement;
}

/// axis, across, readings, scatter_m: "ttir". Of the run id its own row says more.
inline void append_line(Row& row, const RecordedLine& line) {
    const auto& [run_id, axis, across, readings, scatter, rows] = line;
    row.insert(row.end(), {axis, across, row_values::whole(readings), scatter.si()});
}

inline void read_line(RecordedLine& line, RowReader& in) {
    line.axis = in.text();
    line.across = in.text();
    line.readings = in.number<int>();
    line.scatter = in.length();
}

/// target_m, forward_m, backward_m: "rrR".
inline void append_line_row(Row& row, const RecordedLineRow& at) {
    const auto& [target, forward, backward] = at;
    row.insert(row.end(), {target.si(), forward.si(), row_values::si_or_nothing(backward)});
}

inline RecordedLineRow read_line_row(RowReader& in) {
    RecordedLineRow at;
    at.target = in.length();
    at.forward = in.length();
    record_readers::read_optional(at.backward, in);
    return at;
}

/// The set-up that the row belongs to was not read yet. The writer checks each row by itself, and
/// so does who verifies a file; in a file that comes out of order the set-up's own row, which
/// follows then, is refused as the second one.
inline bool stands_alone(const RecordedRun& run) {
    return std::holds_alternative<std::monostate>(run.attachments.setup);
}

} // namespace axiscal::straightness_rows
