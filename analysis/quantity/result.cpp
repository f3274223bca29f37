#include "analysis/quantity/result.hpp"

#include <algorithm>
#include <array>

namespace axiscal {
namespace {

struct FaultRow {
    Fault fault;
    std::uint16_t cnc_code;
    std::string_view name;
    std::string_view sentence;
};

constexpr std::uint16_t no_own_code = 5;

constexpr std::array rows{
    FaultRow{Fault::none, 0, "none", "All is well."},
    FaultRow{Fault::beam_lost, 1, "beam_lost",
             "The laser beam was lost: restore the beam, move to the datum and arm again."},
    FaultRow{Fault::not_still, 2, "not_still",
             "The axis did not come to rest: look for coolant, servo hunting or a dwell that is "
             "too short."},
    FaultRow{Fault::outside_window, 3, "outside_window",
             "The axis is not near the claimed target: compare program and plan."},
    FaultRow{Fault::environment_stale, 4, "environment_stale",
             "An air or material reading is missing or too old: check the sensor and its cable."},
    FaultRow{Fault::bad_command, 5, "bad_command",
             "The CNC sent a command that does not exist here."},
    FaultRow{Fault::overspeed, 6, "overspeed",
             "The axis moved faster than the laser can count: lower the feed, move to the datum "
             "and arm again."},
    FaultRow{Fault::not_durable, 7, "not_durable", "The run file cannot be written to disk."},
    FaultRow{
        Fault::datum_lost, 8, "datum_lost",
        "The counter lost its zero: this run cannot go on; move to the datum and arm a new run."},
    FaultRow{Fault::wrong_target, 9, "wrong_target",
             "The CNC asks for another target than the plan."},
    FaultRow{
        Fault::wrong_direction, 10, "wrong_direction",
        "The target was not reached from the claimed side, or the sign of the reading is wrong."},
    FaultRow{
        Fault::out_of_order, 11, "out_of_order",
        "The request number is not the next one: a request was missed, doubled late or restarted."},
    FaultRow{Fault::no_run_armed, 12, "no_run_armed", "No run is armed: run 'axiscal arm' first."},
    FaultRow{Fault::link_closed, no_own_code, "link_closed",
             "The instrument's connection is closed: check plug and power."},
    FaultRow{Fault::link_timeout, no_own_code, "link_timeout",
             "The instrument does not answer: check cable, address and power."},
    FaultRow{Fault::bad_frame, no_own_code, "bad_frame",
             "The instrument sent something that is not its protocol."},
    FaultRow{Fault::checksum, no_own_code, "checksum",
             "The instrument's message arrived damaged: check cable and baud rate."},
    FaultRow{Fault::signal_error, no_own_code, "signal_error",
             "The instrument reports a signal error."},
    FaultRow{Fault::implausible_jump, no_own_code, "implausible_jump",
             "The reading jumped further than the axis can move: counts were lost."},
    FaultRow{Fault::samples_lost, no_own_code, "samples_lost",
             "Readings of the laser are missing where they are needed as evidence: approach the "
             "target again."},
    FaultRow{Fault::unknown_instrument, no_own_code, "unknown_instrument",
             "The station file names an instrument that does not exist here."},
    FaultRow{Fault::wrong_medium, no_own_code, "wrong_medium",
             "An air channel cannot serve as a material temperature."},
    FaultRow{Fault::stale, no_own_code, "stale", "The value is older than its limit."},
    FaultRow{
        Fault::environment_outside, 4, "environment_outside",
        "Air or machine is outside the limits of the station file: wait until each value is within "
        "its limits again, or remove the cause."},
    FaultRow{Fault::bad_configuration, no_own_code, "bad_configuration",
             "The configuration is refused."},
    FaultRow{Fault::bad_request, no_own_code, "bad_request", "The request is refused."},
    FaultRow{Fault::bad_case, no_own_code, "bad_case", "The case is refused."},
    FaultRow{Fault::bad_run_file, no_own_code, "bad_run_file", "The run file cannot be read."},
    FaultRow{Fault::incomplete_run, no_own_code, "incomplete_run", "The run is not complete."},
    FaultRow{Fault::sequence_lost, 11, "sequence_lost",
             "The CNC stands at another request than the test expects: one was missed, came late, "
             "or was lost in a restart."},
    FaultRow{Fault::busy, no_own_code, "busy", "The station is busy with another run."},
    FaultRow{Fault::refused, no_own_code, "refused", "This is not allowed here."},
    FaultRow{Fault::not_found, no_own_code, "not_found", "Not found."},
    FaultRow{Fault::io, no_own_code, "io", "A file or socket operation failed."},
    FaultRow{Fault::internal, no_own_code, "internal",
             "The program met a state that should not exist."},
};

const FaultRow& row_of(Fault fault) {
    const auto found = std::ranges::find(rows, fault, &FaultRow::fault);
    return found == rows.end() ? rows.back() : *found;
}

} // namespace

std::string_view fault_name(Fault fault) {
    return row_of(fault).name;
}
std::string_view fault_sentence(Fault fault) {
    return row_of(fault).sentence;
}
std::uint16_t cnc_result_code(Fault fault) {
    return row_of(fault).cnc_code;
}

Fault fault_from_name(std::string_view name) {
    const auto found = std::ranges::find(rows, name, &FaultRow::name);
    return found == rows.end() ? Fault::internal : found->fault;
}

namespace {

/// A detail that goes on in the midst of a sentence, which has no colon yet.
bool goes_on(std::string_view sentence, const Error& error) {
    const bool small =
        !error.detail.empty() && error.detail.front() >= 'a' && error.detail.front() <= 'z';
    return small && error.field.empty() && sentence.find(':') == std::string_view::npos;
}

} // namespace

std::string describe(const Error& error) {
    // A detail of these two says all: one would be told that all is well, or that some operation
    // failed.
    const bool says_little = error.fault == Fault::none || error.fault == Fault::io;
    std::string text;
    if (!says_little || error.detail.empty()) text = fault_sentence(error.fault);
    if (!text.empty() && goes_on(text, error)) text.back() = ':';
    const auto add = [&text](const std::string& words) {
        text += (text.empty() ? "" : " ") + words;
    };
    if (!error.field.empty()) add("[" + error.field + "]");
    if (!error.detail.empty()) add(error.detail);
    if (error.cause) text += " (" + error.cause.message() + ")";
    return text;
}

} // namespace axiscal
