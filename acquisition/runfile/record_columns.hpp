#pragma once
// What writing and reading of rows share: the columns of every table but those of setups/, names of
// statements. Pure.

#include "acquisition/runfile/record_rows.hpp"

#include <array>

namespace axiscal {

/// Of every kind of test.
inline constexpr std::array tables{
    Table{"run",
          "run_id, software_version, station, station_config, config_hash, boot_id, "
          "opened_before_ns, opened_utc_ns, opened_after_ns",
          "ttttttiii"},
    Table{"test", "kind", "t"},
    Table{"plan",
          "axis_kind, cycle, pass, remark, approaches, bidirectional, interval_m, seed, overrun_m, "
          "near_tolerance_m, datum_m",
          "ttttiirIrrr"},
    Table{"plan_target", "position_m", "r"},
    Table{"plan_point", "step, target_index, direction, approach", "iiti"},
    Table{"laser",
          "instrument, vacuum_wavelength_m, optical_fold, sign, dead_path_m, beam_walk_m, "
          "beam_walk_travel_m",
          "trrirrr"},
    Table{"material", "coefficient_per_K, standard_uncertainty_per_K, feedback, form", "rRtt"},
    Table{"air", "formula, co2_ppm, oldest_ns", "tri"},
    Table{"rotary",
          "method, step_deg, arm_m, range_deg, turn_time_ns, by_hand, certificate_with_axis, "
          "run_out",
          "trrriiit"},
    Table{"rotary_deviation", "deviation_arcsec", "r"},
    Table{"linear_scale",
          "resolution_m, coefficient_per_K, standard_uncertainty_per_K, temperature_width_K",
          "rrRR"},
    Table{"linear_scale_sensor", "channel", "i"},
    Table{"imported", "file, form, sha256, measured, remark", "ttttt"},
    Table{"uncertainty",
          "device_U_m, device_U_per_m, device_k, device_width_m, device_width_per_m, "
          "misalignment_m, misalignment_rad, temperature_width_K, expansion_width_per_K, eve_m, "
          "eve_model",
          "RRrRRRRRRRt"},
    Table{"uncertainty_target", "parameter, limit_m", "tr"},
    Table{"tolerance_set", "name, source, unit, rule, to_be_checked", "tttti"},
    Table{"tolerance_limit", "parameter, travel_up_to, largest", "tRr"},
    Table{"standard", "name", "t"},
    Table{"statement", "name, value", "tt"},
    Table{"instrument",
          "name, driver, maker, model, serial, firmware, certificate_number, calibrated_on, due_on",
          "ttttttttt"},
    Table{"channel", "id, name, instrument, place, kind, medium, correction", "itttttr"},
    Table{"channel_calibration",
          "channel, certificate_number, calibrated_on, due_on, expanded_uncertainty, "
          "expanded_uncertainty_per_m, coverage",
          "itttRRr"},
    Table{"channel_correction", "channel, reading, correction", "irr"},
    Table{"alignment",
          "began_utc_ns, ended_utc_ns, instrument, serial, travel_m, reached_m, readings, lost, "
          "restarts, far_distance_m, far_highest_m, far_last_m, far_scatter_m, far_blocks, "
          "far_passed_maximum, spot_offset_m",
          "iittrriiiRRRRIIR"},
    Table{"alignment_place",
          "begin_m, end_m, readings, weakest_percent, mean_percent, last_percent", "rrirrr"},
    Table{"eve_source", "run_id", "t"},
    Table{"datum",
          "id, at_ns, coordinate_m, reading_m, epoch, spread_m, slope_um_per_s, n, sequence, "
          "device_count, u_t_ns, synchronisation_um",
          "tirrirriiiIR"},
    Table{"point",
          "step, sequence, planned_step, target_index, direction, approach, origin, triggered_ns, "
          "window_begin_ns, window_end_ns, reading_m, spread_m, slope_um_per_s, n, "
          "approach_travel_m, datum_id, live_deviation_m, u_t_ns, synchronisation_um, samples",
          "iiiititiiirrrirtrIRb"},
    Table{"environment", "channel, at_ns, value", "iir"},
    Table{"event", "kind, at_ns, utc_ns, text, fault, sequence", "tiitti"},
    Table{"stream", "id, channel, name, unit, nominal_rate_hz", "iittr"},
    Table{"stream_block",
          "stream, block, first_count, samples, missing, before, begin_ns, end_ns, low, high, "
          "u_t_ns, data",
          "iiiiitiirrIb"},
    Table{"preflight", "name, passed, warning, verdict, override_reason", "tiitt"},
    Table{"retake", "number, at_ns, utc_ns, reason", "iiit"},
    Table{"retake_point", "step, planned_step", "ii"},
    Table{"exclusion", "step, at_ns, utc_ns, reason", "iiit"},
    Table{"answer", "finding, at_ns, utc_ns, text", "tiit"},
    Table{"ordered", "kind, about, at_ns, utc_ns, door, uid, user, name", "ttiitItt"},
    Table{"closing", "complete, reason, closed_before_ns, closed_utc_ns, closed_after_ns", "itiii"},
};

// Statements are stored by name, so that a new one needs no new column.
struct NamedStatement {
    std::string_view name;
    std::string Statements::*value;
};
inline constexpr std::array named_statements{
    NamedStatement{"certificate_number", &Statements::certificate_number},
    NamedStatement{"customer", &Statements::customer},
    NamedStatement{"place", &Statements::place},
    NamedStatement{"machine", &Statements::machine},
    NamedStatement{"machine_maker", &Statements::machine_maker},
    NamedStatement{"machine_serial", &Statements::machine_serial},
    NamedStatement{"axis", &Statements::axis},
    NamedStatement{"operator_name", &Statements::operator_name},
    NamedStatement{"approver", &Statements::approver},
    NamedStatement{"procedure", &Statements::procedure},
    NamedStatement{"state", &Statements::state},
    NamedStatement{"control_compensation", &Statements::control_compensation},
    NamedStatement{"feed", &Statements::feed},
    NamedStatement{"dwell", &Statements::dwell},
    NamedStatement{"warm_up", &Statements::warm_up},
    NamedStatement{"offsets", &Statements::offsets},
    NamedStatement{"idle_axes", &Statements::idle_axes},
    NamedStatement{"sensor_note", &Statements::sensor_note},
    NamedStatement{"laboratory", &Statements::laboratory},
    NamedStatement{"next_due", &Statements::next_due},
};
static_assert(sizeof(Statements) == named_statements.size() * sizeof(std::string),
              "every statement needs its name in the run file");

} // namespace axiscal
