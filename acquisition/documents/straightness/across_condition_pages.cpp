// What deviations across an axis were measured with, and what happened meanwhile.
#include "acquisition/documents/pdf/back_parts.hpp"
#include "acquisition/documents/positioning/certificate_pages.hpp"
#include "acquisition/documents/straightness/across_pages.hpp"
#include "analysis/record/certificate_expiry.hpp"

#include <algorithm>

namespace axiscal {
namespace {

constexpr const char* said_nowhere = "not stated";

std::string factor_on_paper(const StraightnessSetup& setup) {
    constexpr double per_cent = 100;
    const StraightnessStatement& said = setup.uncertainty;
    std::string words = as_stated(setup.factor);
    if (said.factor_U)
        return words + ", U = " + as_stated(said.factor_U->si() * per_cent) +
               " %, k = " + as_stated(said.factor_k);
    if (said.factor_limit)
        return words + " ± " + as_stated(said.factor_limit->si() * per_cent) + " %";
    return words + ", uncertainty not stated";
}

std::string mirror_on_paper(const StraightnessSetup& setup) {
    std::string words = setup.mirror == MirrorPosition::reversed ? "turned by 180°" : "as at first";
    if (!setup.reversal_of.empty()) words += ", the other way in run " + setup.reversal_of;
    return words;
}

std::vector<StatedField> fields_of_wollaston(const StraightnessSetup& setup) {
    const auto& limit = setup.uncertainty.mirror_limit_um_per_m2;
    return {{"Method", "Wollaston prism and bisecting mirror"},
            {"Factor", factor_on_paper(setup)},
            {"Sign", setup.sign > 0 ? "the reading rises with the deviation"
                                    : "the reading falls with the deviation"},
            {"Mirror", mirror_on_paper(setup)},
            {"Limit of the mirror's form",
             limit ? "± " + as_stated(*limit) + " µm · M² (M in m)" : said_nowhere},
            {"Least step across", setup.resolution > Length{}
                                      ? as_stated(setup.factor * setup.resolution.in(um)) + " µm"
                                      : said_nowhere},
            {"E_VE", um_stated(setup.uncertainty.eve)},
            {"Place of the optics", stated(setup.place)}};
}

std::vector<StatedField> fields_of_angle_steps(const StraightnessSetup& setup) {
    const StraightnessStatement& said = setup.uncertainty;
    const std::optional<Angle> step =
        setup.angle_resolution > Angle{} ? std::optional{setup.angle_resolution} : std::nullopt;
    return {{"Method", "angle of a foot that steps by its base"},
            {"Base", as_stated(setup.base.in(mm)) + " mm, U " + um_stated(said.base_U) +
                         ", k = " + as_stated(said.base_k)},
            {"Sign", setup.sign > 0 ? "the angle rises with the deviation"
                                    : "the angle falls with the deviation"},
            {"U of an angle", arcsec_stated(said.angle_U) + ", k = " + as_stated(said.angle_k)},
            {"Least step of an angle", arcsec_stated(step)},
            {"E_VE", arcsec_stated(said.eve_angle)},
            {"Place of the foot", stated(setup.place)}};
}

std::string datum_of_straightness(const RunRecord& run) {
    if (run.datums.empty()) return said_nowhere;
    return fixed(run.datums.back().coordinate.in(mm), 4) + " mm, id " +
           stated(run.datums.back().id);
}

std::vector<StatedField> fields_of_course(const RunRecord& run) {
    const Statements& said = run.statements;
    return {{"Cycle", std::string{name_of(run.plan.cycle)} + ", pass: " + run.plan.pass},
            {"Approaches n", std::to_string(run.plan.approaches) +
                                 (run.plan.bidirectional ? " in each direction" : " forward")},
            {"Datum", datum_of_straightness(run)},
            {"Over-travel", run.plan.overrun > Length{} ? fixed(run.plan.overrun.in(mm), 3) + " mm"
                                                        : said_nowhere},
            {"Feed", stated(said.feed)},
            {"Dwell", stated(said.dwell)},
            {"Warm-up", stated(said.warm_up)},
            {"Offsets of the measuring line", stated(said.offsets)},
            {"Positions of idle axes", stated(said.idle_axes)},
            {"Note on the sensors", stated(said.sensor_note)},
            {"Station", stated(run.station)},
            {"Compensation", "none: a deviation across does not grow with the axis"}};
}

} // namespace

std::string um_stated(const std::optional<Length>& length) {
    return length ? as_stated(length->in(um)) + " µm" : said_nowhere;
}

std::string arcsec_stated(const std::optional<Angle>& angle) {
    return angle ? as_stated(angle->in(arcsec)) + "″" : said_nowhere;
}

void draw_across_conditions(Sheet& sheet,
                            const AcrossRun& one,
                            const std::vector<StatedField>& square,
                            const std::vector<StatedField>& shortened) {
    const RunRecord& run = one.run;
    const StraightnessSetup& setup = one.optics();
    draw_calibrations(sheet, run.calibrations, run.channels, run_date_of(run));
    sheet.heading("Optics and their set-up");
    sheet.fields(setup.method == StraightnessMethod::wollaston ? fields_of_wollaston(setup)
                                                               : fields_of_angle_steps(setup),
                 2);
    if (!square.empty()) {
        sheet.heading("Optical square");
        sheet.fields(square, 2);
    }
    sheet.heading("Cycle and conditions");
    sheet.fields(fields_of_course(run), 2);
    sheet.fields({{"Station file SHA-256", stated(run.config_hash)}}, 1);
    draw_alignment(sheet, one.attachments.alignment);
    if (std::ranges::find(shortened, "Instruments", &StatedField::key) != shortened.end())
        draw_instruments(sheet, run.instruments, run_date_of(run));
    draw_remarks(sheet, one.remarks, shortened);
    draw_events(sheet, run.events, run.opened);
}

} // namespace axiscal
