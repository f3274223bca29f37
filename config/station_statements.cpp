#include "config/number_pattern.hpp"
#include "config/station_readers.hpp"

namespace axiscal {
namespace {

void read_people(Settings& certificate, Statements& stated) {
    stated.certificate_number = certificate.text("number", "");
    if (std::string mistake = mistake_in_number(stated.certificate_number); !mistake.empty())
        certificate.refuse("number", std::move(mistake));
    stated.laboratory = certificate.text("laboratory", "");
    stated.customer = certificate.text("customer", "");
    stated.place = certificate.text("place", "");
    stated.operator_name = certificate.text("operator", "");
    stated.approver = certificate.text("approver", "");
    stated.procedure = certificate.text("procedure", "");
    stated.next_due = certificate.date("next_due", "", "none");
}

void read_machine(Settings& certificate, Statements& stated) {
    stated.machine = certificate.text("machine", "");
    stated.machine_maker = certificate.text("machine_maker", "");
    stated.machine_serial = certificate.text("machine_serial", "");
    if (certificate.has("state"))
        stated.state = certificate.choice("state", {"as found", "raw", "as left"});
    stated.control_compensation = certificate.text("control_compensation", "");
    stated.warm_up = certificate.text("warm_up", "");
    stated.offsets = certificate.text("offsets", "");
    stated.idle_axes = certificate.text("idle_axes", "");
    stated.sensor_note = certificate.text("sensor_note", "");
}

} // namespace

Statements read_statements(Settings certificate, AxisUnits units, const StationConfig& config) {
    Statements stated;
    read_people(certificate, stated);
    read_machine(certificate, stated);
    // What the part program is written with needs no second statement.
    stated.axis = certificate.text("axis", config.axis.name);
    const bool circles = config.circles_alone();
    const Speed feed = circles ? metre_per_second(config.circular->setup.plan.feed_mm_per_s * 1e-3)
                               : config.cycle.feed;
    const std::string dwell = write_number(seconds_of(config.cycle.dwell)) + " s";
    stated.feed = certificate.text("feed", units.write_speed(feed));
    stated.dwell = certificate.text("dwell", circles ? "" : dwell);
    return stated;
}

} // namespace axiscal
