#include "analysis/positioning/positioning_certificate.hpp"

#include "analysis/record/certificate_expiry.hpp"
#include "analysis/record/channel_correction.hpp"
#include "analysis/record/preflight_remarks.hpp"
#include "analysis/record/run_clock.hpp"
#include "analysis/setup/sensor_findings.hpp"
#include "analysis/setup/setup_words.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>
#include <utility>

namespace axiscal {
namespace {

bool is_environment(const ChannelRecord& channel) {
    return channel.kind != ChannelKind::displacement && channel.kind != ChannelKind::strength &&
           channel.kind != ChannelKind::angle;
}

std::vector<EnvironmentReading> readings_of(const RunRecord& run, int channel) {
    std::vector<EnvironmentReading> readings;
    for (const EnvironmentReading& reading : run.environment)
        if (reading.channel == channel) readings.push_back(reading);
    return readings;
}

EnvironmentSummary summarise(const ChannelRecord& channel,
                             const ChannelCalibration* calibration,
                             const std::vector<EnvironmentReading>& readings) {
    EnvironmentSummary summary;
    summary.channel = channel.name;
    summary.place = channel.place;
    summary.kind = channel.kind;
    summary.medium = channel.medium;
    summary.correction = channel.correction;
    summary.by_table = calibration && !calibration->corrections.empty();
    summary.readings = static_cast<int>(readings.size());
    if (readings.empty()) return summary;
    const auto [low, high] = std::ranges::minmax(readings, {}, &EnvironmentReading::value);
    summary.first = readings.front().value;
    summary.last = readings.back().value;
    summary.minimum = low.value;
    summary.maximum = high.value;
    return summary;
}

EnvironmentTrace trace_of(const ChannelRecord& channel,
                          const std::vector<EnvironmentReading>& readings,
                          MonotonicTime origin) {
    EnvironmentTrace trace;
    trace.channel = channel.name;
    trace.kind = channel.kind;
    trace.medium = channel.medium;
    for (const EnvironmentReading& reading : readings) {
        trace.seconds.push_back(seconds_of(reading.at - origin));
        trace.values.push_back(reading.value);
    }
    return trace;
}

std::string list_of_steps(const std::vector<int>& steps) {
    constexpr std::size_t most = 12;
    std::string text;
    for (std::size_t i = 0; i < std::min(steps.size(), most); ++i)
        text += (i ? ", " : "") + std::to_string(steps[i] + 1);
    return steps.size() > most ? text + ", ..." : text;
}

void remark_on_events(const RunRecord& run, std::vector<std::string>& remarks) {
    const auto utc = [&](const EventRecord& event) {
        return iso8601_utc(event.utc_ns ? event.utc_ns : run.opened.utc_ns_at(event.at));
    };
    for (const EventRecord& event : run.events) {
        const std::string tail = event.text.empty() ? "." : ": " + event.text;
        if (event.kind == EventKind::interrupted)
            remarks.push_back("The run was interrupted at " + utc(event) + tail);
        else if (event.kind == EventKind::resumed)
            remarks.push_back("The run was resumed at " + utc(event) + tail);
        else if (event.kind == EventKind::skipped)
            remarks.push_back("Skipped at " + utc(event) + tail);
    }
}

void remark_on_manual_points(const RunRecord& run, std::vector<std::string>& remarks) {
    std::vector<int> steps;
    for (const PointRecord& point : run.points)
        if (point.origin == TriggerOrigin::manual) steps.push_back(point.planned.step);
    if (steps.empty()) return;
    remarks.push_back(std::to_string(steps.size()) + " of " + std::to_string(run.points.size()) +
                      " points were captured by hand (steps " + list_of_steps(steps) + ").");
}

std::string remark_on_import(const ImportedReadings& imported) {
    return "Imported, readings by others: " + imported.file + ", " + imported.form + ", SHA-256 " +
           imported.sha256 +
           ". How they were compensated for air and material, and whether at all, is not known "
           "here. Drift, alignment and the spread of the material sensors are not among them, so "
           "that no U follows from them." +
           (imported.remark.empty() ? "" : " " + imported.remark);
}

std::vector<std::string> remarks_on(const RunRecord& run, const CompensationSummary& summary) {
    std::vector<std::string> remarks;
    if (run.imported) remarks.push_back(remark_on_import(*run.imported));
    if (!run.plan.remark.empty()) remarks.push_back(run.plan.remark);
    if (run.plan.pass == "stretch")
        remarks.emplace_back("This pass covers a stretch of the axis in its working area, tested "
                             "like a short axis.");
    if (run.plan.cycle == CycleKind::step)
        remarks.emplace_back("Step cycle: all approaches of a target follow each other, which "
                             "hides slow drift.");
    remark_on_events(run, remarks);
    if (!run.imported) remark_on_manual_points(run, remarks);
    for (const std::string& remark : summary.remarks)
        remarks.push_back(remark);
    return remarks;
}

bool names_sensor_in_air(const std::vector<SetupFinding>& findings) {
    return std::ranges::find(findings, SetupError::sensor_in_air, &SetupFinding::error) !=
           findings.end();
}

/// Where a material sensor hangs in the air the axis seems to grow with it, and with nothing else.
bool follows_from(const SetupFinding& found, const std::vector<SetupFinding>& of_sensors) {
    const bool is_growth =
        found.error == SetupError::expansion || found.error == SetupError::growth;
    return is_growth && names_sensor_in_air(of_sensors);
}

std::string who_answered(const RunRevisions& revisions, const std::string& finding) {
    std::string name = "a person";
    for (const OrderRecord& order : revisions.orders)
        if (order.kind == "answer" && order.about == finding) name = name_of(order.by);
    return name;
}

/// Of each finding the last answer, by its name.
std::map<std::string, std::string> last_answers(const RunRevisions& revisions) {
    std::map<std::string, std::string> answers;
    for (const AnswerRecord& answer : revisions.answers)
        answers[answer.finding] = answer.text;
    return answers;
}

/// An answer whose finding has gone, because a point was taken again, is not kept back.
void add_answers(Certificate& certificate) {
    for (const auto& [finding, text] : last_answers(certificate.revisions)) {
        const std::string by = who_answered(certificate.revisions, finding);
        bool stands = false;
        for (SetupFinding& found : certificate.setup_findings) {
            if (name_of(found.error) != finding) continue;
            found.answer = text;
            found.answered_by = by;
            stands = true;
        }
        if (!stands)
            certificate.remarks.push_back("Set-up: these readings no longer show what " + by +
                                          " answered to (" + finding + "): " + text);
    }
}

/// What the readings say of the set-up is no part of the result: where they cannot be searched
/// nothing is found.
void search_setup(Certificate& certificate) {
    const RunRecord& run = certificate.run;
    if (certificate.completeness.partial() || run.rotary || run.imported)
        return add_answers(certificate);
    std::vector<SetupFinding>& findings = certificate.setup_findings;
    findings = find_sensor_errors(run);
    if (const auto course = course_of(run, certificate.revisions, certificate.compensation.after)) {
        auto found = find_setup_error(*course, limits_of(run));
        if (found && !follows_from(*found, findings)) findings.push_back(*std::move(found));
    }
    add_answers(certificate);
    for (const SetupFinding& found : findings)
        certificate.remarks.push_back(sentence_of(found));
}

std::string approach_text(const PlannedPoint& point) {
    return place_of(point.target_index, point.direction) + " " + std::to_string(point.approach + 1);
}

/// "3 readings were replaced ... (P2 ↑ 1, P3 ↑ 1: reason; ...)".
std::string listed(const std::vector<SetAside>& set_aside, bool superseded) {
    std::string text, places, reason;
    const auto flush = [&] {
        if (!places.empty()) text += (text.empty() ? "" : "; ") + places + ": " + reason;
        places.clear();
    };
    for (const SetAside& reading : set_aside) {
        if (reading.superseded != superseded) continue;
        if (reading.reason != reason) flush();
        reason = reading.reason;
        places += (places.empty() ? "" : ", ") + approach_text(reading.planned);
    }
    flush();
    return text;
}

std::ptrdiff_t excluded_readings(const std::vector<SetAside>& set_aside) {
    return std::ranges::count(set_aside, false, &SetAside::superseded);
}

bool rows_are_equal(const RunAt20C& deviations) {
    const auto n = static_cast<std::size_t>(fewest_readings(deviations));
    const auto has_n = [n](const std::vector<double>& row) { return row.size() == n; };
    return std::ranges::all_of(deviations.forward(), has_n) &&
           std::ranges::all_of(deviations.backward(), has_n);
}

/// Axes above 2000 mm, or one turn, take one approach in each direction (ISO 230-2:2014, 4.3.4).
bool is_long_axis(const RunPlan& plan) {
    const auto [low, high] = std::ranges::minmax(plan.targets);
    return high - low > (plan.axis_kind == AxisKind::linear ? mm(2000) : mm(360));
}

void remark_on_number_of_readings(const Certificate& certificate,
                                  std::vector<std::string>& remarks) {
    constexpr int asked = 5; // ISO 230-2:2014, 4.3.3, axes up to 2000 mm
    const RunPlan& plan = certificate.run.plan;
    const int fewest = fewest_readings(certificate.deviations);
    if (fewest >= asked || (fewest == plan.approaches && is_long_axis(plan))) return;
    const std::string left = fewest == 1 ? "one reading" : std::to_string(fewest) + " readings";
    remarks.push_back("At least one target and direction has " + left +
                      ". ISO 230-2 asks for five: the figures are not those of a complete test by "
                      "this standard.");
}

void remark_on_revisions(const Certificate& certificate, std::vector<std::string>& remarks) {
    const auto& set_aside = certificate.set_aside;
    const auto excluded = excluded_readings(set_aside);
    const auto replaced = std::ssize(set_aside) - excluded;
    if (replaced > 0)
        remarks.push_back("Readings replaced by new ones: " + std::to_string(replaced) + " (" +
                          listed(set_aside, true) +
                          "). The replaced ones stay in the run file and are drawn as crosses; no "
                          "figure uses them.");
    if (excluded > 0)
        remarks.push_back("Readings excluded: " + std::to_string(excluded) + " (" +
                          listed(set_aside, false) +
                          "). Rule: an excluded reading is drawn and counted and enters no figure; "
                          "mean and s of its target and direction are of the n readings that "
                          "remain (s with n - 1), at least two. The uncertainty budget takes the "
                          "smallest of these n; "
                          "the simulated uncertainty is left out.");
}

/// Recorded values bear their correction: a table's ends lie where its corrected ends do.
void remark_on_calibrations(const RunRecord& run, std::vector<std::string>& remarks) {
    for (const ChannelCalibration& calibration : run.calibrations) {
        const auto channel =
            std::ranges::find(run.channels, calibration.channel, &ChannelRecord::id);
        if (channel == run.channels.end()) continue;
        const auto readings = readings_of(run, calibration.channel);
        const auto beyond = std::ranges::count_if(readings, [&](const EnvironmentReading& reading) {
            return beyond_corrected(calibration.corrections, reading.value);
        });
        if (beyond > 0)
            remarks.push_back("Channel \"" + channel->name + "\": " + std::to_string(beyond) +
                              " of " + std::to_string(readings.size()) +
                              " readings lie beyond the table of its certificate; the correction "
                              "at the table's end was used.");
        if (has_expired(calibration.due_on, run_date_of(run)))
            remarks.push_back("Channel \"" + channel->name + "\": its certificate was due on " +
                              calibration.due_on + ", before the run.");
    }
}

void fill_environment(Certificate& certificate) {
    const RunRecord& run = certificate.run;
    const MonotonicTime origin =
        std::ranges::min_element(run.points, {}, &PointRecord::window_begin)->window_begin;
    for (const ChannelRecord& channel : run.channels) {
        if (!is_environment(channel)) continue;
        const auto readings = readings_of(run, channel.id);
        certificate.environment.push_back(
            summarise(channel, calibration_of(run, channel.id), readings));
        certificate.traces.push_back(trace_of(channel, readings, origin));
    }
}

void fill_dates(Certificate& certificate) {
    const RunRecord& run = certificate.run;
    certificate.started_utc = iso8601_utc(run.opened.utc_ns);
    certificate.finished_utc = iso8601_utc(run.closed.utc_ns);
    certificate.issued_on = certificate.finished_utc.substr(0, 10);
    certificate.next_due = next_due_of(run.statements, run.closed.utc_ns);
}

/// Of a run that is still open: it ends, as far as anybody knows, with its last reading.
ClockTie tie_of_last_point(const RunRecord& run) {
    const auto last = std::ranges::max_element(run.points, {}, &PointRecord::window_end);
    const MonotonicTime at = last->window_end;
    return {at, tie_of_points(run.opened, run.events).utc_ns_at(at), at};
}

/// What a certificate alone may bear.
void forgo_number(Certificate& certificate) {
    certificate.run.statements.certificate_number.clear();
    certificate.next_due.clear();
    if (certificate.run.uncertainty) certificate.run.uncertainty->targets.clear();
}

/// Appends figures in the form of canonical_bytes(). Pure.
class CanonicalWriter {
public:
    void text(std::string_view words) {
        for (const char c : words)
            bytes_.push_back(static_cast<std::byte>(c));
    }
    void figure(double value) {
        bytes_.push_back(std::byte{1});
        const auto bits = std::bit_cast<std::uint64_t>(value);
        for (unsigned shift = 0; shift < 64; shift += 8)
            bytes_.push_back(static_cast<std::byte>(bits >> shift & 0xffu));
    }
    void figure(const std::optional<double>& value) {
        if (value) return figure(*value);
        bytes_.push_back(std::byte{0});
    }
    [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

private:
    std::vector<std::byte> bytes_;
};

} // namespace

namespace {

/// With the U that the certificate prints, in the unit of the result.
std::vector<FigureToJudge> figures_to_judge(const Certificate& certificate) {
    const double budget_units = budget_units_per(certificate.result.unit);
    const auto& budget = certificate.uncertainty.budget;
    std::vector<FigureToJudge> figures;
    for (const NamedFigure& named : named_figures(certificate.result.parameters)) {
        FigureToJudge figure{named.name, named.value, {}};
        const auto* known = budget ? budget->find(figure.parameter) : nullptr;
        if (known) {
            figure.expanded_uncertainty = known->expanded / budget_units;
            figure.coverage = budget->coverage;
        }
        figures.push_back(std::move(figure));
    }
    for (const OtherResult& other : certificate.others) // whose own figures have no budget here
        for (const NamedFigure& named : other.parameters)
            if (std::ranges::find(figures, named.name, &FigureToJudge::parameter) == figures.end())
                figures.push_back({named.name, named.value, {}});
    return figures;
}

} // namespace

std::optional<Conformity> conformity_of(const Certificate& certificate,
                                        const std::optional<ToleranceRecord>& limits,
                                        std::optional<double> travel) {
    if (certificate.completeness.partial()) return std::nullopt;
    const auto [low, high] = std::ranges::minmax(certificate.planned_targets);
    return conformity_of(limits, figures_to_judge(certificate), certificate.result.unit,
                         travel.value_or(high - low));
}

Result<Certificate> make_certificate(RunRecord run, std::string run_file_sha256) {
    return make_certificate(std::move(run), {}, std::move(run_file_sha256));
}

Result<Certificate>
make_certificate(RunRecord run, RunRevisions revisions, std::string run_file_sha256) {
    AXISCAL_TRY(const ChosenStandards chosen, chosen_standards(run.standards));
    AXISCAL_TRY(Compensated compensated, compensate_to_20C(run, revisions));
    if (!run.complete && run.closed.utc_ns == 0) run.closed = tie_of_last_point(run);
    const Duration clock_off =
        tell_times_by_one_clock(run.opened, run.events, revisions.retakes, run.closed);
    tell_orders_by_one_clock(run.opened, run.events, revisions.orders);
    PositioningResult result = evaluate_positioning(
        compensated.deviations, std::string{chosen.own->name}, chosen.own->cover_factor);
    withhold_from_partial(result, compensated.deviations, run.plan, compensated.completeness);
    Certificate certificate{std::move(run),
                            std::move(result),
                            std::move(compensated.deviations),
                            std::move(compensated.summary),
                            {},
                            {},
                            std::move(run_file_sha256),
                            {},
                            {},
                            {},
                            {},
                            {},
                            true,
                            {},
                            {},
                            std::move(revisions),
                            std::move(compensated.set_aside),
                            std::move(compensated.completeness),
                            std::move(compensated.targets),
                            {}};
    fill_environment(certificate);
    fill_dates(certificate);
    if (certificate.completeness.partial()) forgo_number(certificate);
    certificate.remarks = remarks_on_completeness(certificate.run, certificate.completeness);
    for (std::string& remark : remarks_on(certificate.run, certificate.compensation))
        certificate.remarks.push_back(std::move(remark));
    if (std::string remark = remark_on_clock(clock_off); !remark.empty())
        certificate.remarks.push_back(std::move(remark));
    remark_on_revisions(certificate, certificate.remarks);
    remark_on_number_of_readings(certificate, certificate.remarks);
    remark_on_preflight(certificate.revisions.preflight, certificate.remarks);
    remark_on_calibrations(certificate.run, certificate.remarks);
    certificate.uncertainty =
        uncertainty_of(certificate.run, certificate.result.cover_factor,
                       {fewest_readings(certificate.deviations), certificate.completeness.targets});
    if (excluded_readings(certificate.set_aside) == 0 && rows_are_equal(certificate.deviations))
        simulate_run(certificate.uncertainty, certificate.run, certificate.deviations,
                     certificate.result, certificate.completeness.targets); // the same n of each
    certificate.preliminary = !certificate.uncertainty.missing.empty();
    for (const std::string& remark : certificate.uncertainty.remarks)
        certificate.remarks.push_back(remark);
    search_setup(certificate);
    if (!certificate.completeness.partial())
        for (const PositioningStandard* other : chosen.others)
            certificate.others.push_back(evaluate_other(*other, certificate.deviations));
    certificate.conformity = conformity_of(certificate, certificate.run.tolerances);
    return certificate;
}

std::vector<std::byte> canonical_bytes(const PositioningResult& result) {
    CanonicalWriter out;
    out.text("axiscal.canonical/1");
    out.figure(result.cover_factor);
    out.figure(static_cast<double>(result.approaches));
    const PositioningParameters& p = result.parameters;
    for (const auto& figure : {p.A, p.A_forward, p.A_backward, p.E, p.E_forward, p.E_backward, p.M,
                               p.R, p.R_forward, p.R_backward, p.B, p.B_mean})
        out.figure(figure);
    out.figure(static_cast<double>(result.positions.size()));
    for (const PositionRow& row : result.positions) {
        out.figure(row.target);
        out.figure(row.mean_forward);
        for (const auto& figure :
             {row.mean_backward, row.mean, row.reversal, row.s_forward, row.s_backward,
              row.repeatability_forward, row.repeatability_backward, row.repeatability})
            out.figure(figure);
    }
    return out.take();
}

} // namespace axiscal
