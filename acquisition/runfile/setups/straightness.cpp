// The set-up of a straightness test; its points stand in the tables of every run.
#include "acquisition/runfile/row_values.hpp"
#include "acquisition/runfile/setups/setup_rows.hpp"

#include <array>

namespace axiscal::straightness_rows {
namespace {

using record_readers::read_optional;
using row_values::chained;
using row_values::optional;
using row_values::si_or_nothing;
using row_values::text;
using row_values::whole;

ChainedRow row_of_statement(const StraightnessStatement& statement) {
    const auto& [factor_U, factor_limit, factor_k, mirror_limit, angle_U, angle_k, base_U, base_k,
                 eve, eve_angle] = statement;
    return chained("straightness_uncertainty",
                   {si_or_nothing(factor_U), si_or_nothing(factor_limit), factor_k,
                    optional(mirror_limit), si_or_nothing(angle_U), angle_k, si_or_nothing(base_U),
                    base_k, si_or_nothing(eve), si_or_nothing(eve_angle)});
}

std::vector<ChainedRow> rows(const TestSetup& setup) {
    const auto& [method, across, sign, factor, resolution, mirror, reversal_of, base,
                 angle_resolution, place, uncertainty] = std::get<StraightnessSetup>(setup);
    std::vector<ChainedRow> all;
    all.push_back(chained("straightness", {text(name_of(method)), across, whole(sign), factor,
                                           resolution.si(), text(name_of(mirror)), reversal_of,
                                           base.si(), angle_resolution.si(), place}));
    all.push_back(row_of_statement(uncertainty));
    return all;
}

void read_setup(RecordedRun& run, RowReader& in) {
    auto& setup = only_setup_of<StraightnessSetup>(run, in);
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

void read_statement_of_it(RecordedRun& run, RowReader& in) {
    StraightnessStatement& statement = setup_of<StraightnessSetup>(run, in).uncertainty;
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
}

constexpr std::array all_tables{
    DescribedTable{Table{"straightness",
                         "method, across, sign, factor, resolution_m, mirror, reversal_of, base_m, "
                         "angle_resolution_rad, place",
                         "ttirrttrrt"},
                   read_setup},
    DescribedTable{Table{"straightness_uncertainty",
                         "factor_U, factor_limit, factor_k, mirror_limit_um_per_m2, angle_U_rad, "
                         "angle_k, base_U_m, base_k, eve_m, eve_rad",
                         "RRrRRrRrRR"},
                   read_statement_of_it},
};

} // namespace
} // namespace axiscal::straightness_rows

namespace axiscal {

extern const SetupRows straightness_setup_rows{
    TestKind::straightness, straightness_rows::all_tables, straightness_rows::rows};

} // namespace axiscal
