// The set-up of a circular test.
#include "acquisition/runfile/row_values.hpp"
#include "acquisition/runfile/setups/setup_rows.hpp"

#include <array>
#include <string>

namespace axiscal::circular_setup {
namespace {

using row_values::chained;
using row_values::optional;
using row_values::text;
using row_values::whole;

ChainedRow row_of_circular(const CircularPlan& plan, const CircularCapture& capture) {
    const auto& [plane, radius_mm, feed_mm_per_s, senses, repeats, warm_up, start_deg, arc_deg,
                 overshoot_deg, feed_in_mm, feed_in_outside, centre_mm, tool_offset, work_offset,
                 start, trigger_delay_s] = plan;
    std::string words;
    for (const Sense sense : senses)
        words += (words.empty() ? "" : " ") + std::string{name_of(sense)};
    return chained("circular", {text(name_of(plane)),
                                radius_mm,
                                feed_mm_per_s,
                                words,
                                whole(repeats),
                                whole(warm_up),
                                start_deg,
                                arc_deg,
                                overshoot_deg,
                                feed_in_mm,
                                whole(feed_in_outside),
                                centre_mm[0],
                                centre_mm[1],
                                centre_mm[2],
                                tool_offset,
                                work_offset,
                                capture.sample_rate_hz,
                                optional(capture.low_pass_hz),
                                whole(capture.averaged),
                                text(name_of(start)),
                                trigger_delay_s});
}

ChainedRow row_of_statement(const CircularUncertaintyStatement& statement) {
    const auto& [device, calibration_U, calibration_k, repeatability, eve, centre, machine_degC,
                 bar_degC, machine_alpha, bar_alpha, runs] = statement;
    return chained("circular_uncertainty",
                   {optional(device), optional(calibration_U), optional(calibration_k),
                    optional(repeatability), optional(eve), optional(centre),
                    optional(machine_degC), optional(bar_degC), optional(machine_alpha),
                    optional(bar_alpha), whole(runs)});
}

std::vector<ChainedRow> rows(const TestSetup& setup) {
    const auto& [plan, capture, bar_instrument, bar_sign, bar_length_mm, bar_alpha, machine_alpha,
                 temperature_channel, uncertainty] = std::get<CircularSetup>(setup);
    Value channel;
    if (temperature_channel) channel = whole(*temperature_channel);
    std::vector<ChainedRow> all;
    all.push_back(row_of_circular(plan, capture));
    all.push_back(chained("circular_bar", {bar_instrument, whole(bar_sign), bar_length_mm,
                                           optional(bar_alpha), optional(machine_alpha), channel}));
    all.push_back(row_of_statement(uncertainty));
    return all;
}

void read_circular(RecordedRun& run, RowReader& in) {
    CircularPlan plan;
    plan.plane = in.choice({CircularPlane::xy, CircularPlane::yz, CircularPlane::zx});
    plan.nominal_radius_mm = in.real();
    plan.feed_mm_per_s = in.real();
    const std::string senses = in.text();
    plan.senses.clear();
    for (std::size_t at = 0; at < senses.size(); at = senses.find(' ', at) + 1) {
        const std::string word = senses.substr(at, senses.find(' ', at) - at);
        if (word != "ccw" && word != "cw") in.reject("\"" + word + "\" is no sense");
        plan.senses.push_back(word == "cw" ? Sense::cw : Sense::ccw);
        if (senses.find(' ', at) == std::string::npos) break;
    }
    plan.repeats = in.number<int>();
    plan.warm_up = in.number<int>();
    plan.start_deg = in.real();
    plan.arc_deg = in.real();
    plan.overshoot_deg = in.real();
    plan.feed_in_mm = in.real();
    plan.feed_in_outside = in.flag();
    for (double& coordinate : plan.centre_mm)
        coordinate = in.real();
    plan.tool_offset = in.text();
    plan.work_offset = in.text();
    auto& setup = setup_of<CircularSetup>(run, in);
    setup.plan = std::move(plan);
    setup.capture.sample_rate_hz = in.real();
    setup.capture.low_pass_hz = in.optional_real();
    setup.capture.averaged = in.number<int>();
    setup.plan.start = in.choice({StartMethod::feed_step, StartMethod::trigger});
    setup.plan.trigger_delay_s = in.real();
}

void read_circular_bar(RecordedRun& run, RowReader& in) {
    auto& setup = setup_of<CircularSetup>(run, in);
    setup.bar_instrument = in.text();
    setup.bar_sign = in.number<int>();
    setup.bar_length_mm = in.real();
    setup.bar_alpha_per_K = in.optional_real();
    setup.machine_alpha_per_K = in.optional_real();
    const auto channel = in.optional_integer();
    if (channel) setup.bar_temperature_channel = static_cast<int>(*channel);
}

void read_circular_uncertainty(RecordedRun& run, RowReader& in) {
    CircularUncertaintyStatement& statement = setup_of<CircularSetup>(run, in).uncertainty;
    for (auto* value :
         {&statement.device_width_um, &statement.calibration_U_um, &statement.calibration_k,
          &statement.repeatability_um, &statement.eve_um, &statement.centre_width_um,
          &statement.machine_temperature_width_K, &statement.bar_temperature_width_K,
          &statement.machine_alpha_width_per_K, &statement.bar_alpha_width_per_K})
        *value = in.optional_real();
    statement.runs = in.number<int>();
}

constexpr std::array all_tables{
    DescribedTable{
        Table{"circular",
              "plane, radius_mm, feed_mm_per_s, senses, repeats, warm_up, start_deg, arc_deg, "
              "overshoot_deg, feed_in_mm, feed_in_outside, centre_x_mm, centre_y_mm, centre_z_mm, "
              "tool_offset, work_offset, sample_rate_hz, low_pass_hz, averaged, start_from, "
              "trigger_delay_s",
              "trrtiirrrrirrrttrRitr"},
        read_circular},
    DescribedTable{Table{"circular_bar",
                         "instrument, sign, length_mm, bar_alpha_per_K, machine_alpha_per_K, "
                         "temperature_channel",
                         "tirRRI"},
                   read_circular_bar},
    DescribedTable{
        Table{"circular_uncertainty",
              "device_width_um, calibration_U_um, calibration_k, repeatability_um, eve_um, "
              "centre_width_um, machine_temperature_width_K, bar_temperature_width_K, "
              "machine_alpha_width_per_K, bar_alpha_width_per_K, runs",
              "RRRRRRRRRRi"},
        read_circular_uncertainty},
};

} // namespace
} // namespace axiscal::circular_setup

namespace axiscal {

extern const SetupRows circular_setup_rows{TestKind::circular, circular_setup::all_tables,
                                           circular_setup::rows};

} // namespace axiscal
