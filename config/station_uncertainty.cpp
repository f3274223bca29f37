#include "config/station_readers.hpp"

namespace axiscal {

void refuse_beside(Settings& table, std::string_view first, std::string_view second) {
    if (table.has(first) && table.has(second))
        table.refuse(second,
                     "is given together with " + std::string{first} + ": remove one of the two");
}

namespace {

void read_device(Settings& table, UncertaintySetup& setup) {
    constexpr double least_k = 1, largest_k = 5;
    refuse_beside(table, "device", "device_width");
    setup.device_U = table.device_limit("device");
    setup.device_width = table.device_limit("device_width");
    setup.device_k = table.number("device_k", least_k, largest_k, setup.device_k);
    if (table.has("device_k") && !table.has("device"))
        table.refuse("device_k", "belongs to device, the expanded uncertainty: state that one too");
}

void read_alignment(Settings& table, UncertaintySetup& setup) {
    refuse_beside(table, "misalignment", "misalignment_angle");
    const bool offset = table.has("misalignment"), angle = table.has("misalignment_angle");
    const Length by_offset = table.length("misalignment", mm(0), mm(100), mm(0));
    const Angle by_angle = table.angle("misalignment_angle", radian(0), radian(0.1), radian(0));
    if (offset) setup.misalignment = by_offset;
    if (angle && !offset) setup.misalignment_angle = by_angle;
}

void read_machine_side(Settings& table, UncertaintySetup& setup) {
    const TemperatureDifference width =
        table.temperature_difference("temperature_width", kelvin(0), kelvin(50), kelvin(0));
    if (table.has("temperature_width")) setup.temperature_width = width;
    const Expansion expansion = table.expansion("expansion_width", um_per_m_kelvin(0),
                                                um_per_m_kelvin(100), um_per_m_kelvin(0));
    if (table.has("expansion_width")) setup.expansion_width = expansion;
    const Length drift = table.length("eve", mm(0), mm(1), mm(0));
    if (table.has("eve")) setup.eve = drift;
    if (table.choice("eve_model", {"mean", "difference"}, "mean") == "difference")
        setup.eve_model = EveModel::difference;
}

void read_targets(Settings target, UncertaintySetup& setup) {
    for (const std::string_view parameter : positioning_parameters) {
        const Length limit = target.length(parameter, mm(0), mm(1), mm(0));
        if (target.has(parameter)) setup.targets.push_back({std::string{parameter}, limit});
    }
}

/// The budget of a rotary axis has device and environment alone: temperature, expansion and
/// alignment are in the device. One millimetre stands for one degree.
void read_angle_terms(Settings& table, UncertaintySetup& setup) {
    constexpr double least_k = 1, largest_k = 5;
    const auto angle = [&table](const char* key) {
        const Length amount = table.rotary_length(key, mm(0), mm(1), mm(0));
        return table.has(key) ? std::optional{amount} : std::nullopt;
    };
    refuse_beside(table, "device", "device_width");
    setup.device_U.fixed = angle("device");
    setup.device_width.fixed = angle("device_width");
    setup.device_k = table.number("device_k", least_k, largest_k, setup.device_k);
    if (table.has("device_k") && !table.has("device"))
        table.refuse("device_k", "belongs to device, the expanded uncertainty: state that one too");
    setup.eve = angle("eve");
    if (table.choice("eve_model", {"mean", "difference"}, "mean") == "difference")
        setup.eve_model = EveModel::difference;
    Settings target = table.table("target");
    for (const std::string_view parameter : positioning_parameters) {
        const Length limit = target.rotary_length(parameter, mm(0), mm(1), mm(0));
        if (target.has(parameter)) setup.targets.push_back({std::string{parameter}, limit});
    }
}

} // namespace

std::optional<UncertaintySetup>
read_uncertainty(Settings root, AxisKind kind, std::string& eve_run) {
    const bool stated = root.has("uncertainty");
    Settings table = root.table("uncertainty");
    UncertaintySetup setup;
    refuse_beside(table, "eve", "eve_run");
    eve_run = table.text("eve_run", "");
    if (kind == AxisKind::rotary) {
        read_angle_terms(table, setup);
        return stated ? std::optional{std::move(setup)} : std::nullopt;
    }
    read_device(table, setup);
    read_alignment(table, setup);
    read_machine_side(table, setup);
    read_targets(table.table("target"), setup);
    return stated ? std::optional{std::move(setup)} : std::nullopt;
}

} // namespace axiscal
