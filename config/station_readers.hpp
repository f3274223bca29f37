#pragma once
// The station file table by table. Internal to config/. Pure.

#include "config/measure.hpp"
#include "config/section_readers.hpp"

namespace axiscal {

/// Fills config.instruments and config.instrument_options.
void read_instruments(Settings root, StationConfig& config);
/// After the instruments, which its roles name. Travel and kind go to config.cycle.
void read_axis(Settings axis, AxisUnits units, StationConfig& config);
/// How the angle of a rotary axis is measured, after the instruments, which a role names.
/// `has_laser`: axis.laser is named.
AngleConfig read_angle(Settings angle, bool has_laser, const StationConfig& station);
/// Of a station without [axis], whose [circular] says what is known of the machine.
void read_machine_of_circles(Settings circular, StationConfig& config);
/// Nothing without the table.
void read_ballbar(Settings root, StationConfig& config);
/// The bar's certificate in [ballbar] and the cycle in [circular]; after read_ballbar.
void read_circular(Settings root, StationConfig& config);
void read_cycle(Settings cycle, AxisUnits units, CycleConfig& config);
void read_capture(Settings capture,
                  AxisUnits units,
                  const CycleConfig& cycle,
                  CaptureConfig& config);
PreflightConfig read_preflight(Settings preflight);
EnvironmentLimits read_environment(Settings environment);
/// After the cycle, whose overrun a dwell trigger must be able to see.
void read_trigger(Settings trigger,
                  AxisUnits units,
                  const CycleConfig& cycle,
                  Duration capture_timeout,
                  TriggerConfig& config);
/// Nothing without the table. `eve_run`: StationConfig::eve_run.
std::optional<UncertaintySetup>
read_uncertainty(Settings root, AxisKind kind, std::string& eve_run);
/// Nothing without the table. After the axis, whose kind gives the units.
void read_tolerances(Settings root, StationConfig& config);
/// Nothing without the table.
void read_webhook(Settings root, StationConfig& station);
Statements read_statements(Settings certificate, AxisUnits units, const StationConfig& config);

/// Addresses and networks that may connect, as in ["192.168.10.20", "192.168.20.0/24"].
std::vector<AddressRange> read_allowed_clients(Settings& door);
/// A door that other computers hear needs its list of clients.
void refuse_open_door(Settings& door,
                      const std::string& host,
                      const std::vector<AddressRange>& allowed);
/// A numeric IPv4 or IPv6 address, as a listener needs it; refuses a name.
std::string read_address(Settings& table,
                         std::string_view key,
                         const std::optional<std::string>& fallback = {});
/// "/run/..."; refuses a path that depends on where the daemon was started.
std::string read_absolute_path(Settings& table,
                               std::string_view key,
                               const std::optional<std::string>& fallback = {});

} // namespace axiscal
