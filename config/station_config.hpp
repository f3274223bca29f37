#pragma once
// The station file as checked structs. Reading opens no device.

#include "analysis/record/circular_setup.hpp"
#include "analysis/record/run_record.hpp"
#include "analysis/record/test_kind.hpp"
#include "config/address_range.hpp"
#include "config/environment_limits.hpp"
#include "config/instrument_config.hpp"
#include "config/preflight_config.hpp"
#include "config/settings.hpp"

#include <any>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace axiscal {

enum class TriggerShape : std::uint8_t { sequence_block, single_register, coil_and_index, dwell };
enum class TriggerTransport : std::uint8_t {
    none,
    tcp_server,
    rtu_server,
    tcp_client
}; ///< client: the CNC is the server (mirrored)

/// A capture that ends without a word is refused so long after its time-out.
inline constexpr Duration capture_answer_grace = std::chrono::seconds{2};
/// The CNC waits longer than the station: it then hears why, and is not gone when the point comes.
/// Beside the grace a second for the way to the disk and over the wire.
constexpr Duration least_cnc_timeout(Duration capture_timeout) {
    return capture_timeout + capture_answer_grace + std::chrono::seconds{1};
}
/// With the default of 10 s longer than the watchdog needs to bring the daemon back (12 s).
constexpr Duration usual_cnc_timeout(Duration capture_timeout) {
    return capture_timeout + std::chrono::seconds{5};
}

struct TriggerConfig {
    TriggerShape shape = TriggerShape::sequence_block;
    TriggerTransport transport = TriggerTransport::tcp_server;
    std::string host = "127.0.0.1"; ///< listen address, or the CNC's address when mirrored
    int port = 1502;
    std::string serial_path; ///< RTU
    int baud = 115200;
    char parity = 'N';
    int stop_bits = 1;
    int unit_id = 1;
    int base_address = 0;        ///< mirrored: base of the block in the CNC's map
    bool low_word_first = false; ///< 32-bit word order
    int client_limit = 8;
    /// Clients that may connect; empty only where the listener hears this PC alone.
    std::vector<AddressRange> allowed_clients;
    Duration poll_interval = std::chrono::milliseconds{75};
    /// How long the CNC's program waits for an answer.
    Duration cnc_timeout = usual_cnc_timeout(std::chrono::seconds{10});
    bool watch_heartbeat = false; ///< CNC_HEARTBEAT frozen > 2 s is a fault
    /// coil-and-index: how long a rising coil with the previous index waits for the index to be
    /// rewritten; longer than one pass of the client.
    Duration index_grace = std::chrono::milliseconds{50};
    // dwell: window and hysteresis about the target, then still for the period and halted
    Length window = mm(0.5);
    Length stability_range = um(1.0);
    Duration stability_period = std::chrono::milliseconds{500};
    Length hysteresis;
    Duration minimum_halt = std::chrono::seconds{1};
};

/// When a standing axis counts as still, and how long one waits for it.
struct CaptureConfig {
    Duration window = std::chrono::milliseconds{500}; ///< stability period
    Length spread_limit;                              ///< stability range over the window
    double slope_limit_um_per_s = 1;
    Duration timeout = std::chrono::seconds{10};
    Duration history = std::chrono::minutes{5};
    int minimum_samples = 20;
    Speed fastest; ///< the axis can not move faster: beyond it a reading is an implausible jump
};

struct CycleConfig {
    CycleKind cycle = CycleKind::standard;
    AxisKind axis_kind = AxisKind::linear;
    Length travel_low, travel_high;
    std::optional<std::vector<Length>> targets; ///< a given list, or:
    std::optional<Length> interval;             ///< p
    std::optional<Length>
        first_target;                ///< P_1 before its random part; default: low + overrun + 0.3 p
    std::optional<int> target_count; ///< m; default: as many as fit
    std::optional<std::uint64_t> seed; ///< default: drawn once per run and recorded
    int approaches = 5;
    bool bidirectional = true;
    Length overrun;
    std::optional<Length> near_tolerance; ///< default min(0.5 mm, p/10)
    std::optional<Length> datum;          ///< default: P_1 - 2 overrun, not below the travel
    std::optional<Length> feedback_pitch; ///< screw or scale period whose phases must spread
    Speed feed;
    Duration dwell = std::chrono::seconds{3};
    std::optional<std::string>
        stretch_declined; ///< long axis: reason for not doing the 2000 mm stretch
    std::optional<Length> stretch_begin;
};

struct RoleConfig {                  ///< which instrument channel plays which part
    std::string instrument, channel; ///< "air", "air temperature"
    /// Not named in the file: the only channel that can play the part; of material sensors, all.
    /// The loader names it.
    bool by_kind = false;
};

/// A circular test with a ballbar.
struct CircularConfig {
    CircularSetup setup; ///< without the ids of channels, which the station resolves
    std::optional<RoleConfig> bar_temperature;
    /// Drift test of the ballbar that E_VE comes from: its run id, or "latest"; empty:
    /// setup.uncertainty.eve_um counts.
    std::string eve_run;
};

/// Of a rotary axis: the artefact under the instrument, and its papers.
struct AngleConfig {
    RotarySetup setup;
    RoleConfig autocollimator; ///< reads the faces of a polygon; empty: a person types
    InstrumentRecord artefact;
};

/// A linear scale that measures the axis in the laser's place; AxisConfig::laser names its channel.
struct ScaleConfig {
    ScaleSetup setup; ///< without resolution and ids of channels, which the station resolves
    std::vector<RoleConfig> temperature;
};

struct AxisConfig {
    std::string name = "X";
    /// Of the reference: laser, or scale. Empty: StationConfig::circles_alone(), or a polygon.
    RoleConfig laser;
    int sign = 1;
    Length dead_path, beam_walk, beam_walk_travel;
    MaterialSetup material;
    AirSetup air;
    RoleConfig air_temperature, air_pressure, air_humidity;
    std::vector<RoleConfig> material_temperature;
    std::string program_axis = "X";   ///< axis letter in part programs
    std::optional<AngleConfig> angle; ///< of a rotary axis
    std::optional<ScaleConfig> scale; ///< then nothing is asked of beam and air
};

inline constexpr std::string_view single_material_sensor =
    "one material sensor: ISO 230-2 measurements want at least two along the axis, for a gradient "
    "cannot be seen by one";

struct ConsoleConfig {
    std::string socket_path = "/run/axiscal/axiscald.sock";
    std::string group = "axiscal"; ///< empty: leave the process group
    std::string host = "127.0.0.1";
    int port = 8470;                        ///< 0: no TCP
    std::vector<std::string> allowed_hosts; ///< Host headers known besides host:port and localhost
    std::vector<AddressRange> allowed_clients; ///< who may connect over TCP; empty: everybody
    /// PEM files; both, or neither: TCP speaks HTTP without TLS then.
    std::string certificate, key;
    int certificate_line = 0, key_line = 0; ///< of the station file
    [[nodiscard]] bool speaks_tls() const { return port != 0 && !certificate.empty(); }
};

struct PublishConfig {
    /// Folder, or smb:// address that parse_share_address() takes; empty: results stay in the
    /// outbox.
    std::string destination;
    /// Who reads the results in a folder of this PC: it passes its group on to them; empty: nobody
    /// beside the service.
    std::string group;
    std::string credentials;        ///< file of the share's account; empty: see docs/share.md
    bool require_encryption = true; ///< else it is asked for, and signing is required
    Duration timeout = std::chrono::seconds{10}; ///< of one call to the server
    Duration retry = std::chrono::seconds{5};
    Duration alarm_age = std::chrono::minutes{15}; ///< of the oldest waiting result
    int alarm_count = 10;                          ///< of waiting results
};

/// Who is told by a signed POST (docs/webhook.md).
struct WebhookConfig {
    std::string url;         ///< that parse_webhook_address() takes; never logged
    std::string place;       ///< its scheme, server and port
    std::string secret_file; ///< by which it is signed
    std::string ca_file;     ///< of the authorities that vouch for the server; empty: the system's
    bool on_complete = true, on_fault = true;
    int line = 0; ///< of the table in the station file
};

/// A table that only one kind of test has: its set-up (TestSetup) names it, `section`.
struct KindSection {
    TestKind kind = TestKind::positioning;
    Settings table;  ///< read by the kind, then finish() refuses the rest
    std::any config; ///< what the kind read of it: config_of(). Empty: nobody did
};

struct StationConfig {
    std::string file, text; ///< path and whole text
    std::string station = "station";
    std::string state_directory = "/var/lib/axiscal"; ///< runs/, outbox/, token
    AxisConfig axis;
    std::optional<RoleConfig> ballbar;      ///< which channel measures the ballbar's length, if any
    std::optional<CircularConfig> circular; ///< absent: no circular test
    CycleConfig cycle;
    CaptureConfig capture;
    PreflightConfig preflight;
    EnvironmentLimits environment;
    TriggerConfig trigger;
    ConsoleConfig console;
    PublishConfig publish;
    std::optional<WebhookConfig> webhook;        ///< absent: nobody is told
    std::optional<UncertaintySetup> uncertainty; ///< of a linear axis; absent: no such table
    /// Drift test that E_VE comes from: its run id, or "latest"; empty: uncertainty->eve counts.
    std::string eve_run;
    /// Of every kind of test; limits in um, those of a rotary axis in arcsec; travels in mm or
    /// degrees. `unit` is left to the run.
    std::optional<ToleranceRecord> tolerances;
    /// By which positioning runs are evaluated; the loader knows their names. Empty: ISO
    /// 230-2:2014.
    std::vector<std::string> standards;
    Statements statements;
    std::vector<InstrumentConfig> instruments;
    /// The driver's own keys of instruments[i]; read by the driver, then finish() refuses the rest.
    std::vector<Settings> instrument_options;
    std::vector<KindSection> kind_sections; ///< those that stand in the file
    /// What a person should know although it is allowed (a single material sensor); by line.
    std::vector<Refusal> warnings;

    /// A ballbar and no laser: the station measures circles and nothing else. Of `axis` only its
    /// name (that of the plane), material, material_temperature and perhaps air_temperature count.
    [[nodiscard]] bool circles_alone() const {
        return circular && axis.laser.instrument.empty() && !axis.laser.by_kind;
    }
};

/// Reads every key of the station but those of drivers and of single kinds of test. Refusals stay
/// in `document`; the returned struct is usable only when document.finish() is empty afterwards.
StationConfig read_station(SettingsDocument& document);

} // namespace axiscal
