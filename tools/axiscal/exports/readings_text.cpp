#include "tools/axiscal/exports/readings_text.hpp"

#include "acquisition/documents/csv_text.hpp"
#include "analysis/record/run_clock.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>
#include <utility>

namespace axiscal {
namespace {

constexpr std::string_view line_end = "\r\n";

/// No exponent, whatever the size, and no "-0".
std::string fixed_point(double value, int places) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.*f", places, value);
    const bool zero =
        std::string_view{text.data()}.find_first_of("123456789") == std::string_view::npos;
    return zero && text[0] == '-' ? text.data() + 1 : text.data();
}

class Laser10 {
public:
    explicit Laser10(const Certificate& certificate)
        : certificate_{certificate}
        , run_{certificate.run} {}

    std::string text() {
        section("HEADER", {"File type  : rtl", "Owner      : Linear", "Version no : V20.02.02"});
        targets();
        const Statements& said = run_.statements;
        section("USER-TEXT", {"Machine:" + said.machine, "Serial No:" + said.machine_serial,
                              "Date:" + date(), "By:" + said.operator_name, "Axis:" + said.axis,
                              "Location:" + said.place, "TITLE:" + run_.run_id});
        deviations();
        environment();
        text_ += "EOF::";
        return text_ += line_end;
    }

private:
    void line(const std::string& text) { (text_ += text) += line_end; }
    void section(const char* name, const std::vector<std::string>& lines) {
        line(std::string{name} + "::");
        for (const std::string& one : lines)
            line(one);
        line({});
    }

    void targets() {
        const auto& targets = certificate_.deviations.targets();
        const bool both = !certificate_.deviations.backward().empty();
        line("TARGET DATA::");
        line("Filetype  : ISO");
        line("Target-count: " + std::to_string(targets.size()));
        line("Targets :");
        constexpr std::size_t a_line = 5;
        std::string row;
        for (std::size_t i = 0; i < targets.size(); ++i) {
            row += (row.empty() ? "" : "  ") + fixed_point(targets[i], 6);
            if ((i + 1) % a_line == 0 || i + 1 == targets.size()) line(std::exchange(row, {}));
        }
        line(both ? "Flags: 0 0 2 0" : "Flags: 0 1 2 0");
        line({});
    }

    void run_of(std::size_t number,
                const std::vector<std::vector<double>>& rows,
                std::size_t approach,
                bool falling) {
        constexpr double um_per_mm = 1000;
        for (std::size_t k = 0; k < rows.size(); ++k) {
            const std::size_t i = falling ? rows.size() - 1 - k : k;
            line(std::to_string(number) + "   " + std::to_string(i + 1) + "      " +
                 fixed_point(rows[i][approach] * um_per_mm, 6));
        }
    }

    void deviations() {
        const auto& forward = certificate_.deviations.forward();
        const auto& backward = certificate_.deviations.backward();
        const std::size_t approaches = forward.front().size();
        const std::size_t ways = backward.empty() ? 1 : 2;
        section("RUNS", {"Run-count:" + std::to_string(approaches * ways)});
        line("DEVIATIONS::");
        line("Run Target Data:");
        for (std::size_t j = 0; j < approaches; ++j) {
            run_of(ways * j + 1, forward, j, false);
            if (ways == 2) run_of(ways * j + 2, backward, j, true);
        }
        line({});
    }

    /// First and last reading; the first channel of its kind and medium.
    [[nodiscard]] const EnvironmentSummary*
    channel(ChannelKind kind, Medium medium, int nth = 0) const {
        for (const EnvironmentSummary& one : certificate_.environment)
            if (one.kind == kind && one.medium == medium && nth-- == 0) return &one;
        return nullptr;
    }
    void
    between(const char* key, const EnvironmentSummary* channel, double factor, const char* code) {
        if (channel == nullptr) return;
        line(std::string{key} + ": " + fixed_point(channel->first * factor, 6) + " " +
             fixed_point(channel->last * factor, 6) + code);
    }

    void environment() {
        constexpr double kPa_per_Pa = 1e-3, ppm = 1e6;
        line("ENVIRONMENT::");
        between("Air temp   ", channel(ChannelKind::temperature, Medium::air), 1, " 0");
        between("Air press  ", channel(ChannelKind::pressure, Medium::air), kPa_per_Pa, " 1");
        between("Air humid  ", channel(ChannelKind::humidity, Medium::air), 1, "");
        for (int n = 0; n < 3; ++n)
            between(("Mat temp " + std::to_string(n + 1) + " ").c_str(),
                    channel(ChannelKind::temperature, Medium::material, n), 1, " 0");
        if (run_.imported) return; // nothing of it is known
        const std::string alpha = fixed_point(run_.material.coefficient.si() * ppm, 6);
        line("Exp coeff  : " + alpha + " " + alpha + " 0");
    }

    [[nodiscard]] std::string date() const {
        if (run_.imported) return run_.imported->measured;
        std::string text = certificate_.started_utc.substr(0, 19);
        std::ranges::replace(text, 'T', ' ');
        return text;
    }

    const Certificate& certificate_;
    const RunRecord& run_;
    std::string text_;
};

bool rows_are_whole(const Certificate& certificate) {
    const auto approaches = static_cast<std::size_t>(certificate.run.plan.approaches);
    const auto whole = [&](const std::vector<double>& row) { return row.size() == approaches; };
    return std::ranges::all_of(certificate.deviations.forward(), whole) &&
           std::ranges::all_of(certificate.deviations.backward(), whole);
}

} // namespace

Result<std::string> laser10_text(const Certificate& certificate) {
    if (certificate.run.plan.axis_kind == AxisKind::rotary)
        return fail(Fault::refused,
                    "Laser10 text is written of linear axes: no document says which "
                    "unit an angle has in it; use --format csv");
    if (certificate.completeness.partial() || !rows_are_whole(certificate))
        return fail(Fault::refused,
                    "a reading is missing or left out, and Laser10 text has no place "
                    "for a gap; use --format csv");
    return Laser10{certificate}.text();
}

std::string readings_csv(const Certificate& certificate) {
    const RunRecord& run = certificate.run;
    const bool rotary = run.plan.axis_kind == AxisKind::rotary;
    std::string csv;
    const auto stated = [&](const char* key, const std::string& value) {
        if (!value.empty()) csv += std::string{"# "} + key + ": " + value + "\n";
    };
    stated("run", run.run_id);
    stated("machine", run.statements.machine);
    stated("axis", run.statements.axis);
    stated("readings", "deviations");
    for (const SetAside& reading : certificate.set_aside)
        csv += "# left out, step " + std::to_string(reading.step) + "\n";
    append_csv_line(csv, {"run", "direction", rotary ? "target [deg]" : "target [mm]",
                          rotary ? "deviation [arcsec]" : "deviation [um]", "time"});
    const ClockTie tie = tie_of_points(run.opened, run.events);
    for (const PlannedPoint& planned : run.plan.points) {
        const auto point = std::ranges::find(
            run.points, planned.step, [](const PointRecord& one) { return one.planned.step; });
        const bool there = point != run.points.end() &&
                           std::ranges::find(certificate.set_aside, point->step, &SetAside::step) ==
                               certificate.set_aside.end();
        const auto k = static_cast<std::size_t>(point - run.points.begin());
        const double factor = rotary ? 3600 : 1000;
        append_csv_line(
            csv, {std::to_string(planned.approach + 1),
                  planned.direction == Direction::positive ? "+" : "-",
                  csv_number(certificate.planned_targets.at(
                      static_cast<std::size_t>(planned.target_index))),
                  there ? csv_number(certificate.compensation.after.at(k) * factor) : "",
                  there && !run.imported ? iso8601_utc(tie.utc_ns_at(point->window_end)) : ""});
    }
    return csv;
}

} // namespace axiscal
