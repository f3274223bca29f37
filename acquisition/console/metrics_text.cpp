#include "acquisition/console/metrics_text.hpp"

#include "acquisition/console/metrics_instruments.hpp"
#include "acquisition/console/metrics_writer.hpp"
#include "acquisition/live/station_interface.hpp"

#include <array>

namespace axiscal {
namespace {

constexpr std::array<std::string_view, 6> run_states{"tying datum", "armed",    "settling",
                                                     "stopped",     "complete", "incomplete"};
constexpr std::array<std::string_view, 3> drift_states{"recording", "complete", "incomplete"};
constexpr std::array<std::string_view, 4> publisher_states{"idle", "publishing", "waiting",
                                                           "nowhere"};

/// Every fault that there is but `none`.
std::vector<std::string_view> fault_names() {
    std::vector<std::string_view> names;
    for (int fault = 1; fault <= static_cast<int>(Fault::internal); ++fault)
        names.push_back(fault_name(static_cast<Fault>(fault)));
    return names;
}

void write_station(MetricsWriter& to, const StationStatus& status) {
    to.family("axiscal_build_info", MetricType::gauge,
              "The version of axiscald that answers; always 1.");
    to.sample({{"version", status.version}}, 1);
    to.family("axiscal_station_info", MetricType::gauge,
              "Names of the station and its axis; always 1.");
    to.sample({{"station", status.station},
               {"axis", status.axis.name},
               {"kind", std::string{name_of(status.axis.kind)}}},
              1);
    to.family("axiscal_up", MetricType::gauge, "1: the loop of the station answers.");
    to.sample(1);
    to.family("axiscal_run_open", MetricType::gauge,
              "1 while a run is open; a drift test is none.");
    to.sample(status.run_open ? 1 : 0);
}

void write_points(MetricsWriter& to, const RunStatus& run) {
    to.family("axiscal_run_points_planned", MetricType::gauge,
              "Points, or circles, that the open or last run has by its plan.");
    to.sample(run.steps);
    to.family("axiscal_run_points_durable", MetricType::gauge,
              "Points, or circles, of the open or last run that are on the disk.");
    to.sample(run.step);
    to.family("axiscal_run_points_skipped", MetricType::gauge,
              "Points skipped and not taken since.");
    to.sample(run.skipped);
    to.family("axiscal_run_points_excluded", MetricType::gauge, "Points that a person left out.");
    to.sample(run.excluded);
    to.family("axiscal_run_retakes_left", MetricType::gauge, "Points still to be taken again.");
    to.sample(run.retakes_left);
}

void write_run(MetricsWriter& to, const RunStatus& run) {
    to.family("axiscal_run_info", MetricType::gauge,
              "What the open or last run measures; always 1.");
    to.sample({{"pass", run.pass}}, 1);
    to.family("axiscal_run_state", MetricType::gauge,
              "1 for the state of the open or last run, else 0.");
    to.states({}, "state", run_states, run.state);
    write_points(to, run);
    to.family("axiscal_run_remaining_seconds", MetricType::gauge,
              "How long the open run will still take.");
    to.sample(run.seconds_left);
    to.family("axiscal_run_fault", MetricType::gauge,
              "1 for what refused the last request or ended the run, else 0.");
    const bool troubled = !run.last_fault.empty();
    to.states({}, "fault", fault_names(),
              troubled ? fault_name(fault_from_name(run.last_fault)) : std::string_view{});
    to.family("axiscal_run_certificate_ready", MetricType::gauge,
              "1 once the certificate of the last run is made.");
    to.sample(run.certificate.empty() ? 0 : 1);
}

void write_drift(MetricsWriter& to, const DriftView& drift) {
    to.family("axiscal_drift_state", MetricType::gauge,
              "1 for the state of the drift test, else 0.");
    to.states({}, "state", drift_states, drift.state);
    to.family("axiscal_drift_readings_planned", MetricType::gauge,
              "Readings that the drift test will have.");
    to.sample(drift.planned);
    to.family("axiscal_drift_readings_taken", MetricType::gauge,
              "Readings that the drift test has.");
    to.sample(drift.taken);
    to.family("axiscal_drift_readings_missing", MetricType::gauge,
              "Intervals of the drift test without a reading.");
    to.sample(drift.missing);
}

struct PortFamily {
    std::string_view name, help;
    std::uint64_t PortCounters::*count;
};
constexpr std::array port_families{
    PortFamily{"axiscal_trigger_requests_total", "Modbus requests answered.",
               &PortCounters::requests},
    PortFamily{"axiscal_trigger_exceptions_total",
               "Modbus requests answered by an exception of the map or the protocol.",
               &PortCounters::exceptions},
    PortFamily{"axiscal_trigger_reconnects_total", "Lines opened again after an error.",
               &PortCounters::reconnects},
    PortFamily{"axiscal_trigger_torn_reads_total",
               "Mirrored blocks that changed between their two readings.",
               &PortCounters::torn_reads},
    PortFamily{"axiscal_trigger_overtaken_total",
               "Requests on the RTU line that another frame followed, so that nobody was answered.",
               &PortCounters::overtaken},
    PortFamily{"axiscal_trigger_late_indices_total", "Indices that came after their coil.",
               &PortCounters::late_indices},
};

void write_trigger(MetricsWriter& to, const StationStatus& status) {
    const PortCounters& counters = status.trigger_counters;
    to.family("axiscal_cnc_silent", MetricType::gauge, "1 while the CNC's heartbeat has stopped.");
    to.sample(status.cnc_silent ? 1 : 0);
    to.family("axiscal_trigger_faulty", MetricType::gauge,
              "1 while the trigger port says what is wrong.");
    to.sample(status.trigger_note.empty() ? 0 : 1);
    for (const PortFamily& family : port_families) {
        to.family(family.name, MetricType::counter, family.help);
        to.sample(static_cast<double>(counters.*family.count));
    }
    to.family("axiscal_trigger_clients_turned_away_total", MetricType::counter,
              "Clients of the trigger port that had to go, by reason.");
    to.sample({{"reason", "refused"}}, static_cast<double>(counters.refused));
    to.sample({{"reason", "stranger"}}, static_cast<double>(counters.strangers));
    to.sample({{"reason", "hung_up"}}, static_cast<double>(counters.hung_up));
}

void write_outbox(MetricsWriter& to, const OutboxView& outbox) {
    to.family("axiscal_outbox_entries", MetricType::gauge, "Results that wait for the share.");
    to.sample(outbox.waiting);
    to.family("axiscal_outbox_oldest_age_seconds", MetricType::gauge,
              "How long the oldest of them waits; no line while none does.");
    to.sample(outbox.oldest_s);
    to.family(
        "axiscal_outbox_alarm", MetricType::gauge,
        "1 while more wait, or longer, than publish.alarm_count and publish.alarm_age allow.");
    to.sample(outbox.alarm.empty() ? 0 : 1);
    to.family("axiscal_publisher_up", MetricType::gauge, "1 while the publisher process runs.");
    to.sample(outbox.publisher_runs ? 1 : 0);
    if (outbox.state.empty()) return;
    to.family("axiscal_publisher_state", MetricType::gauge,
              "1 for the state of the publisher, else 0.");
    to.states({}, "state", publisher_states, outbox.state);
}

} // namespace

std::string metrics_text(const StationStatus& status) {
    MetricsWriter to;
    write_station(to, status);
    if (status.run) write_run(to, *status.run);
    if (status.drift) write_drift(to, *status.drift);
    write_trigger(to, status);
    write_outbox(to, status.outbox);
    write_metrics_of(status.instruments, to);
    write_metrics_of(status.channels, to);
    return to.text();
}

} // namespace axiscal
