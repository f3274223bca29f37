#include "acquisition/program/part_program.hpp"

#include "acquisition/program/table_halts.hpp"
#include "analysis/rotary/rotary_position.hpp"
#include "drivers/framing/checksum.hpp"

#include "config/measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace axiscal {
namespace {

constexpr std::array dialects{
    ProgramDialect{"linuxcnc", ".ngc",
                   "LinuxCNC: waits on digital input 0 for the station's answer", write_linuxcnc},
    ProgramDialect{"marlin", ".gcode",
                   "Marlin and other printer firmware: dwell trigger, G4 P in milliseconds",
                   write_marlin},
};

} // namespace

Result<void> check_prepare(const ProgramOrder& order) {
    if (!order.datum_by_cnc || order.shape == TriggerShape::sequence_block) return {};
    return fail(
        Fault::bad_request,
        "only trigger.shape = \"sequence-block\" can send prepare: leave --datum-by-cnc out "
        "and give 'axiscal arm' when the axis waits at its datum");
}

Result<void> check_answer_limit(Duration answer_limit, Duration capture_timeout) {
    if (answer_limit >= least_cnc_timeout(capture_timeout)) return {};
    return fail(Fault::bad_request,
                "the program would wait for an answer " + std::to_string(seconds_of(answer_limit)) +
                    " s and the station needs " +
                    std::to_string(seconds_of(least_cnc_timeout(capture_timeout))) +
                    " s at most: lengthen trigger.cnc_timeout");
}

std::vector<ProgramMove> moves_of(const RunPlan& plan) {
    // 0.1 nm of slack: "at least the overrun" must not fail by the rounding of mm arithmetic.
    constexpr double slack_mm = 1e-7;
    const double overrun_mm = plan.overrun.in(mm);
    double here_mm = plan.datum.in(mm);
    std::vector<ProgramMove> moves{{here_mm, nullptr, {}}};
    for (const PlannedPoint& point : plan.points) {
        const double target_mm = plan.targets[static_cast<std::size_t>(point.target_index)].in(mm);
        const double side = point.direction == Direction::positive ? 1.0 : -1.0;
        if (side * (target_mm - here_mm) < overrun_mm - slack_mm)
            moves.push_back({target_mm - side * overrun_mm, nullptr, {}});
        moves.push_back({target_mm, &point, {}});
        here_mm = target_mm;
    }
    return moves;
}

std::vector<ProgramMove> moves_with_table(const RunPlan& plan, const RotarySetup& setup) {
    const double datum_deg = plan.datum.in(mm), overrun_deg = plan.overrun.in(mm);
    double here_deg = datum_deg;
    int position = 0;
    std::vector<ProgramMove> moves{{datum_deg, nullptr, 0}};
    for (const PlannedPoint& point : plan.points) {
        const Length target = plan.targets[static_cast<std::size_t>(point.target_index)];
        const double side = point.direction == Direction::positive ? 1.0 : -1.0;
        const double begin_deg = target.in(mm)-side * overrun_deg;
        const int wanted = artefact_index(setup, plan.datum, target);
        const auto halts = table_halts(setup, datum_deg, here_deg, position, begin_deg, wanted);
        for (const TableHalt& halt : halts)
            moves.push_back({halt.coordinate_deg, nullptr, halt.position});
        if (halts.empty() || halts.back().coordinate_deg != begin_deg)
            moves.push_back({begin_deg, nullptr, {}});
        moves.push_back({target.in(mm), &point, {}});
        position = wanted;
        here_deg = target.in(mm);
    }
    return moves;
}

std::span<const ProgramDialect> program_dialects() {
    return dialects;
}

Result<ProgramDialect> find_dialect(std::string_view name) {
    std::string known;
    std::vector<std::string> names;
    for (const ProgramDialect& dialect : dialects) {
        if (dialect.name == name) return dialect;
        known += (known.empty() ? "" : ", ") + std::string{dialect.name};
        names.emplace_back(dialect.name);
    }
    return fail(Fault::bad_request, "there is no dialect '" + std::string{name} + "'; known are " +
                                        known + did_you_mean(name, names));
}

std::string program_id(const RunPlan& plan) {
    std::string targets;
    for (const Length target : plan.targets)
        targets += std::to_string(std::lround(target.in(um)*10)) + ";";
    char hex[8];
    std::snprintf(hex, sizeof hex, "%04X", static_cast<unsigned>(crc16_xmodem(targets)));
    return "seed=" + (plan.seed ? std::to_string(*plan.seed) : "none") + " pass=" + plan.pass +
           " targets=" + std::to_string(plan.targets.size()) +
           " n=" + std::to_string(plan.approaches) + " check=" + hex;
}

std::string coordinate_word(const std::string& axis, double coordinate_mm) {
    char word[40];
    std::snprintf(word, sizeof word, "%s%.4f", axis.c_str(),
                  coordinate_mm == 0 ? 0.0 : coordinate_mm);
    return word;
}

} // namespace axiscal
