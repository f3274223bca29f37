#include "acquisition/console/metrics_text.hpp"

#include "acquisition/console/metrics_writer.hpp"
#include "acquisition/live/station_interface.hpp"
#include "tests/support/source_dir.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <limits>
#include <numbers>
#include <regex>
#include <set>
#include <sstream>

namespace axiscal::metrics_text_test {
namespace {

using Names = std::set<std::string>;

StationStatus idle_station() {
    StationStatus status;
    status.station = "bay \"3\" C:\\axiscal";
    status.version = "0.1.0";
    status.axis.name = "X";
    return status;
}

ChannelView channel_of(ChannelKind kind, std::optional<double> value) {
    ChannelView channel;
    channel.instrument = "air";
    channel.channel = name_of(kind);
    channel.name = "for people";
    channel.place = "beside the beam";
    channel.kind = kind;
    channel.value = value;
    channel.age_s = 0.25;
    channel.quality = value ? "good" : "stale";
    channel.role = "environment";
    channel.due_on = "2027-03-31";
    return channel;
}

InstrumentView laser() {
    InstrumentView view;
    view.name = "laser";
    view.driver = "umd";
    view.state = InstrumentState::faulty;
    view.last_fault = Fault::beam_lost;
    view.due_on = "2027-03-31";
    view.restarts = 3;
    view.counters.samples = 9007199254740992;
    return view;
}

RunStatus open_run() {
    RunStatus run;
    run.run_id = "bay-3-20261121T100000Z-X";
    run.pass = "whole";
    run.state = "armed";
    run.step = 12;
    run.steps = 110;
    run.seconds_left = 40.5;
    return run;
}

/// Every family that there can be has a sample.
StationStatus full_station() {
    StationStatus status = idle_station();
    status.run = open_run();
    status.run_open = true;
    status.drift = DriftView{};
    status.drift->state = "recording";
    status.outbox.waiting = 2;
    status.outbox.oldest_s = 1320;
    status.outbox.state = "waiting";
    status.instruments = {laser()};
    for (const ChannelKind kind :
         {ChannelKind::displacement, ChannelKind::temperature, ChannelKind::pressure,
          ChannelKind::humidity, ChannelKind::carbon_dioxide, ChannelKind::strength,
          ChannelKind::angle})
        status.channels.push_back(channel_of(kind, 45));
    return status;
}

/// The samples of one family, without their heads.
std::string samples_of(const std::string& text, const std::string& family) {
    std::istringstream lines{text};
    std::string found;
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(family + "{") || line.starts_with(family + " ")) found += line + "\n";
    return found;
}

Names names_in(const std::string& text, const std::regex& name) {
    Names names;
    for (std::sregex_iterator at{text.begin(), text.end(), name}, end; at != end; ++at)
        names.insert((*at)[1]);
    return names;
}

Names families_of(const std::string& text) {
    return names_in(text, std::regex{"# TYPE (\\w+) "});
}

int count_in(const std::string& text, const std::string& words) {
    int count = 0;
    for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1))
        ++count;
    return count;
}

TEST(MetricsWriter, EscapesWhatALabelMayNotHoldAndRepairsWhatIsNoUtf8) {
    MetricsWriter to;
    to.family("axiscal_x", MetricType::gauge, "A thing.");
    to.sample({{"name", "a\\b\"c\nd\xff"}, {"other", ""}}, 1);
    EXPECT_EQ(to.text(), "# HELP axiscal_x A thing.\n# TYPE axiscal_x gauge\n"
                         "axiscal_x{name=\"a\\\\b\\\"c d\uFFFD\",other=\"\"} 1\n");
}

TEST(MetricsWriter, WritesNumbersSoThatTheyReadBackAndWholeOnesPlainly) {
    MetricsWriter to;
    to.family("axiscal_x_total", MetricType::counter, "A thing.");
    for (const double value : {0.0, -0.0, 1e5, 101325.0, 9007199254740992.0, 0.1, -1.5e-9, 1e300})
        to.sample(value);
    EXPECT_EQ(samples_of(to.text(), "axiscal_x_total"),
              "axiscal_x_total 0\naxiscal_x_total 0\naxiscal_x_total 100000\n"
              "axiscal_x_total 101325\naxiscal_x_total 9007199254740992\naxiscal_x_total 0.1\n"
              "axiscal_x_total -1.5e-09\naxiscal_x_total 1e+300\n");
}

TEST(MetricsWriter, LeavesOutWhatIsNoNumberAndAFamilyWithoutASample) {
    MetricsWriter to;
    to.family("axiscal_x", MetricType::gauge, "A thing.");
    to.sample(std::nullopt);
    to.sample(std::numeric_limits<double>::quiet_NaN());
    to.sample(std::numeric_limits<double>::infinity());
    EXPECT_EQ(to.text(), "");
}

TEST(MetricsText, OfAnIdleStationWithoutInstruments) {
    EXPECT_EQ(metrics_text(idle_station()),
              R"(# HELP axiscal_build_info The version of axiscald that answers; always 1.
# TYPE axiscal_build_info gauge
axiscal_build_info{version="0.1.0"} 1
# HELP axiscal_station_info Names of the station and its axis; always 1.
# TYPE axiscal_station_info gauge
axiscal_station_info{station="bay \"3\" C:\\axiscal",axis="X",kind="linear"} 1
# HELP axiscal_up 1: the loop of the station answers.
# TYPE axiscal_up gauge
axiscal_up 1
# HELP axiscal_run_open 1 while a run is open; a drift test is none.
# TYPE axiscal_run_open gauge
axiscal_run_open 0
# HELP axiscal_cnc_silent 1 while the CNC's heartbeat has stopped.
# TYPE axiscal_cnc_silent gauge
axiscal_cnc_silent 0
# HELP axiscal_trigger_faulty 1 while the trigger port says what is wrong.
# TYPE axiscal_trigger_faulty gauge
axiscal_trigger_faulty 0
# HELP axiscal_trigger_requests_total Modbus requests answered.
# TYPE axiscal_trigger_requests_total counter
axiscal_trigger_requests_total 0
# HELP axiscal_trigger_exceptions_total Modbus requests answered by an exception of the map or the protocol.
# TYPE axiscal_trigger_exceptions_total counter
axiscal_trigger_exceptions_total 0
# HELP axiscal_trigger_reconnects_total Lines opened again after an error.
# TYPE axiscal_trigger_reconnects_total counter
axiscal_trigger_reconnects_total 0
# HELP axiscal_trigger_torn_reads_total Mirrored blocks that changed between their two readings.
# TYPE axiscal_trigger_torn_reads_total counter
axiscal_trigger_torn_reads_total 0
# HELP axiscal_trigger_overtaken_total Requests on the RTU line that another frame followed, so that nobody was answered.
# TYPE axiscal_trigger_overtaken_total counter
axiscal_trigger_overtaken_total 0
# HELP axiscal_trigger_late_indices_total Indices that came after their coil.
# TYPE axiscal_trigger_late_indices_total counter
axiscal_trigger_late_indices_total 0
# HELP axiscal_trigger_clients_turned_away_total Clients of the trigger port that had to go, by reason.
# TYPE axiscal_trigger_clients_turned_away_total counter
axiscal_trigger_clients_turned_away_total{reason="refused"} 0
axiscal_trigger_clients_turned_away_total{reason="stranger"} 0
axiscal_trigger_clients_turned_away_total{reason="hung_up"} 0
# HELP axiscal_outbox_entries Results that wait for the share.
# TYPE axiscal_outbox_entries gauge
axiscal_outbox_entries 0
# HELP axiscal_outbox_alarm 1 while more wait, or longer, than publish.alarm_count and publish.alarm_age allow.
# TYPE axiscal_outbox_alarm gauge
axiscal_outbox_alarm 0
# HELP axiscal_publisher_up 1 while the publisher process runs.
# TYPE axiscal_publisher_up gauge
axiscal_publisher_up 0
)");
}

TEST(MetricsText, AValueThatIsNotGoodHasItsAgeAndItsQualityAndNoNumber) {
    StationStatus status = idle_station();
    status.channels = {channel_of(ChannelKind::temperature, {})};
    status.channels[0].age_s = 14;
    const std::string text = metrics_text(status);
    EXPECT_EQ(text.find("axiscal_channel_temperature_celsius"), std::string::npos);
    const std::string labels = "{instrument=\"air\",channel=\"temperature\"";
    EXPECT_EQ(samples_of(text, "axiscal_channel_age_seconds"),
              "axiscal_channel_age_seconds" + labels + "} 14\n");
    const std::string quality = "axiscal_channel_quality" + labels + ",quality=\"";
    EXPECT_EQ(samples_of(text, "axiscal_channel_quality"),
              quality + "good\"} 0\n" + quality + "stale\"} 1\n" + quality + "signal_error\"} 0\n" +
                  quality + "beam_lost\"} 0\n" + quality + "absent\"} 0\n" + quality +
                  "none\"} 0\n");
}

TEST(MetricsText, AChannelThatNeverSpokeHasNoAge) {
    StationStatus status = idle_station();
    status.channels.emplace_back();
    const std::string text = metrics_text(status);
    EXPECT_EQ(text.find("axiscal_channel_age_seconds"), std::string::npos);
    EXPECT_EQ(count_in(text, "quality=\"none\"} 1\n"), 1);
}

TEST(MetricsText, EveryValueIsInItsBaseUnit) {
    struct Case {
        ChannelKind kind;
        double stored, shown;
        std::string family;
    };
    for (const Case& one :
         {Case{ChannelKind::displacement, -0.0123456789, -0.0123456789, "displacement_metres"},
          Case{ChannelKind::temperature, 20.5, 20.5, "temperature_celsius"},
          Case{ChannelKind::pressure, 101325, 101325, "pressure_pascals"},
          Case{ChannelKind::humidity, 45.2, 0.452, "humidity_ratio"},
          Case{ChannelKind::carbon_dioxide, 450, 450e-6, "carbon_dioxide_ratio"},
          Case{ChannelKind::strength, 80, 0.8, "strength_ratio"},
          Case{ChannelKind::angle, 3600, std::numbers::pi / 180, "angle_radians"}}) {
        StationStatus status = idle_station();
        status.channels = {channel_of(one.kind, one.stored)};
        const std::string line = samples_of(metrics_text(status), "axiscal_channel_" + one.family);
        ASSERT_EQ(count_in(line, "\n"), 1) << one.family << ": " << line;
        EXPECT_DOUBLE_EQ(std::stod(line.substr(line.rfind(' '))), one.shown) << one.family;
    }
}

TEST(MetricsText, OneStateOfARunIsOneAndAnUnknownOneIsNone) {
    StationStatus status = idle_station();
    status.run = open_run();
    for (const char* state :
         {"tying datum", "armed", "settling", "stopped", "complete", "incomplete"}) {
        status.run->state = state;
        const std::string states = samples_of(metrics_text(status), "axiscal_run_state");
        EXPECT_EQ(count_in(states, "\n"), 6);
        EXPECT_EQ(count_in(states, "} 1\n"), 1);
        EXPECT_EQ(count_in(states, "{state=\"" + std::string{state} + "\"} 1\n"), 1) << states;
    }
    status.run->state = "on holiday";
    EXPECT_EQ(count_in(samples_of(metrics_text(status), "axiscal_run_state"), "} 1\n"), 0);
}

TEST(MetricsText, FaultsOfARunAreThoseThatThereAreWhateverItSays) {
    StationStatus status = idle_station();
    status.run = open_run();
    const std::string none = samples_of(metrics_text(status), "axiscal_run_fault");
    EXPECT_EQ(count_in(none, "\n"), static_cast<int>(Fault::internal));
    EXPECT_EQ(names_in(none, std::regex{"fault=\"(\\w+)\""}).size(),
              static_cast<std::size_t>(Fault::internal));
    EXPECT_EQ(count_in(none, "} 1\n"), 0);
    EXPECT_EQ(count_in(none, "fault=\"none\""), 0);
    status.run->last_fault = "datum_lost";
    const std::string lost = samples_of(metrics_text(status), "axiscal_run_fault");
    EXPECT_EQ(count_in(lost, "} 1\n"), 1);
    EXPECT_EQ(count_in(lost, "{fault=\"datum_lost\"} 1\n"), 1);
    status.run->last_fault = "a word of next year";
    EXPECT_EQ(count_in(metrics_text(status), "{fault=\"internal\"} 1\n"), 1);
}

TEST(MetricsText, PointsAndTheTimeThatIsLeftStandThereOnceThereIsARun) {
    StationStatus status = idle_station();
    status.run = open_run();
    status.run_open = true;
    const std::string text = metrics_text(status);
    EXPECT_EQ(samples_of(text, "axiscal_run_open"), "axiscal_run_open 1\n");
    EXPECT_EQ(samples_of(text, "axiscal_run_points_durable"), "axiscal_run_points_durable 12\n");
    EXPECT_EQ(samples_of(text, "axiscal_run_points_planned"), "axiscal_run_points_planned 110\n");
    EXPECT_EQ(samples_of(text, "axiscal_run_remaining_seconds"),
              "axiscal_run_remaining_seconds 40.5\n");
    EXPECT_EQ(text.find("bay-3-2026"), std::string::npos) << "a run id would be a series a run";
}

TEST(MetricsText, AnInstrumentShowsItsStateItsLastFaultAndUntilWhenItsCertificateHolds) {
    StationStatus status = idle_station();
    status.instruments = {laser()};
    const std::string text = metrics_text(status);
    const std::string state = "axiscal_instrument_state{instrument=\"laser\",state=\"";
    EXPECT_EQ(samples_of(text, "axiscal_instrument_state"),
              state + "unavailable\"} 0\n" + state + "available\"} 0\n" + state + "faulty\"} 1\n" +
                  state + "tape\"} 0\n");
    EXPECT_EQ(samples_of(text, "axiscal_instrument_last_fault"),
              "axiscal_instrument_last_fault{instrument=\"laser\",fault=\"beam_lost\"} 1\n");
    EXPECT_EQ(samples_of(text, "axiscal_instrument_restarts_total"),
              "axiscal_instrument_restarts_total{instrument=\"laser\"} 3\n");
    EXPECT_EQ(samples_of(text, "axiscal_instrument_samples_total"),
              "axiscal_instrument_samples_total{instrument=\"laser\"} 9007199254740992\n");
    // The day itself still counts: it is over on 2027-04-01 at 00:00 UTC.
    EXPECT_EQ(samples_of(text, "axiscal_instrument_certificate_expiry_timestamp_seconds"),
              "axiscal_instrument_certificate_expiry_timestamp_seconds{instrument=\"laser\"} "
              "1806537600\n");
}

TEST(MetricsText, WhatIsNotStatedOrNoDateHasNoExpiry) {
    StationStatus status = idle_station();
    status.instruments = {laser()};
    for (const char* date : {"", "2027-02-29", "soon", "2027-3-31"}) {
        status.instruments[0].due_on = date;
        EXPECT_EQ(metrics_text(status).find("expiry"), std::string::npos) << date;
    }
}

TEST(MetricsText, TheOutboxShowsWhatWaitsAndWhatThePublisherSays) {
    StationStatus status = idle_station();
    status.outbox.waiting = 2;
    status.outbox.oldest_s = 1320;
    status.outbox.alarm = "2 results wait for the share since 22 min";
    status.outbox.publisher_runs = true;
    status.outbox.state = "waiting";
    status.outbox.reason = "smb://fs1/quality: Connection refused";
    const std::string text = metrics_text(status);
    EXPECT_EQ(samples_of(text, "axiscal_outbox_entries"), "axiscal_outbox_entries 2\n");
    EXPECT_EQ(samples_of(text, "axiscal_outbox_oldest_age_seconds"),
              "axiscal_outbox_oldest_age_seconds 1320\n");
    EXPECT_EQ(samples_of(text, "axiscal_outbox_alarm"), "axiscal_outbox_alarm 1\n");
    EXPECT_EQ(samples_of(text, "axiscal_publisher_up"), "axiscal_publisher_up 1\n");
    EXPECT_EQ(samples_of(text, "axiscal_publisher_state"),
              "axiscal_publisher_state{state=\"idle\"} 0\n"
              "axiscal_publisher_state{state=\"publishing\"} 0\n"
              "axiscal_publisher_state{state=\"waiting\"} 1\n"
              "axiscal_publisher_state{state=\"nowhere\"} 0\n");
    EXPECT_EQ(text.find("smb:"), std::string::npos) << "free text would be a series a sentence";
}

TEST(MetricsText, EveryFamilyHasOneHelpAndOneTypeBeforeItsSamplesWhichStandTogether) {
    const std::string text = metrics_text(full_station());
    std::istringstream lines{text};
    Names seen;
    std::string family;
    for (std::string line; std::getline(lines, line);) {
        const std::string name = line.starts_with("# ") ? line.substr(7, line.find(' ', 7) - 7)
                                                        : line.substr(0, line.find_first_of("{ "));
        if (line.starts_with("# HELP ")) {
            EXPECT_TRUE(seen.insert(name).second) << name << " has two heads";
            family = name;
        }
        EXPECT_EQ(name, family) << line;
    }
    EXPECT_EQ(count_in(text, "# HELP "), static_cast<int>(seen.size()));
    EXPECT_EQ(count_in(text, "# TYPE "), static_cast<int>(seen.size()));
    EXPECT_EQ(families_of(text), seen);
    EXPECT_TRUE(text.ends_with("\n"));
}

TEST(MetricsText, NoSeriesStandsThereTwice) {
    std::istringstream lines{metrics_text(full_station())};
    Names seen;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("#")) continue;
        EXPECT_TRUE(seen.insert(line.substr(0, line.rfind(' '))).second) << line;
    }
}

TEST(MetricsText, NamesFollowTheConventionsOfPrometheus) {
    const std::string text = metrics_text(full_station());
    const Names short_units{"s",  "ms", "us", "ns", "min", "h", "mm",
                            "um", "m",  "pa", "c",  "kb",  "mb"};
    for (const std::string& name : families_of(text)) {
        EXPECT_TRUE(std::regex_match(name, std::regex{"axiscal(_[a-z]+)+"})) << name;
        const bool counts = text.find("# TYPE " + name + " counter\n") != std::string::npos;
        EXPECT_EQ(name.ends_with("_total"), counts) << name;
        for (const std::string& part : names_in(name, std::regex{"_?([a-z]+)"}))
            EXPECT_FALSE(short_units.contains(part)) << name;
    }
    for (const std::string& label : names_in(text, std::regex{"[{,](\\w+)=\""}))
        EXPECT_TRUE(std::regex_match(label, std::regex{"[a-z]+(_[a-z]+)*"})) << label;
}

TEST(MetricsText, ThePageDescribesEveryFamilyAndNoOther) {
    std::ifstream file{test::source_dir() + "/docs/metrics.md"};
    const std::string page{std::istreambuf_iterator<char>{file}, {}};
    const Names there_are = families_of(metrics_text(full_station()));
    EXPECT_EQ(names_in(page, std::regex{"\\| `(axiscal_\\w+)"}), there_are);
    for (const std::string& name : names_in(page, std::regex{"\\b(axiscal_\\w+)"}))
        EXPECT_TRUE(there_are.contains(name)) << "the page speaks of " << name;
}

} // namespace
} // namespace axiscal::metrics_text_test
