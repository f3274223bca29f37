#include "wire/usb/usb_instruments.hpp"

#include "simulated_machine.hpp"
#include "wire/can/can_instruments.hpp"
#include "wire/usb/ds9490r_device.hpp"
#include "wire/usb/gs_usb_device.hpp"
#include "wire/usb/temper_device.hpp"
#include "wire/usb/u6_device.hpp"
#include "wire/usb/usbtenki_device.hpp"

#include <cmath>
#include <numbers>

namespace axiscal::simulate {

Result<std::unique_ptr<UsbDevice>> make_usbtenki(const UsbWish& wish, const UsbWorld& world) {
    auto air = [air = world.scenario.air, clock = world.clock] {
        return air_at(air, clock.now_s());
    };
    return std::make_unique<UsbTenkiDevice>(wish.text("serial", "A10234"), std::move(air));
}

Result<std::unique_ptr<UsbDevice>> make_labjack_u6(const UsbWish& wish, const UsbWorld& world) {
    AXISCAL_TRY(const double serial, wish.number("serial", "470012345"));
    AXISCAL_TRY(const double volts, wish.number("volts", "0"));
    AXISCAL_TRY(const double swing, wish.number("swing", "0"));
    AXISCAL_TRY(const double period_s, wish.number("period_s", "10"));
    if (!(serial >= 0 && serial < 4294967296.0) || !(period_s > 0))
        return fail(Fault::bad_request, "serial is a number of 32 bits, period_s above 0");
    U6Device::World seen;
    seen.now_s = [clock = world.clock] { return clock.now_s(); };
    seen.volts = [volts, swing, period_s](double seconds) {
        return volts + swing * std::sin(2 * std::numbers::pi * seconds / period_s);
    };
    return std::make_unique<U6Device>(static_cast<std::uint32_t>(serial), std::move(seen));
}

Result<std::unique_ptr<UsbDevice>> make_temper(const UsbWish& wish, const UsbWorld& world) {
    auto shown = [scenario = world.scenario, clock = world.clock] {
        const double seconds = clock.now_s();
        const TrueAir air = air_at(scenario.air, seconds);
        TemperShown show;
        show.stick_degC = air.temperature.in_celsius();
        show.probe_degC = material_at(scenario.thermal, seconds).in_celsius();
        show.humidity_percent = air.humidity.in(percent);
        return show;
    };
    return std::make_unique<TemperDevice>(wish.text("firmware", "TEMPerX_V3.3"), std::move(shown));
}

Result<std::unique_ptr<UsbDevice>> make_gs_usb(const UsbWish& wish, const UsbWorld& world) {
    AXISCAL_TRY(const double mm, wish.number("mm", "1"));
    const auto none = [](double) { return 0; };
    const CanTransWorld warm{[thermal = world.scenario.thermal](double seconds) {
                                 return material_at(thermal, seconds).in_celsius();
                             },
                             none};
    TemposonicsWorld far;
    far.metres = [mm](double) { return 1e-3 * mm; };
    far.area = none;
    std::vector<std::unique_ptr<CanNode>> nodes;
    nodes.push_back(make_cantrans(125, warm));
    nodes.push_back(make_temposonics(127, far));
    for (const auto& node : nodes)
        node->power_on(world.clock.now_s());
    return std::make_unique<GsUsbDevice>(
        wish.text("serial", "003A00295553501420393933"),
        [clock = world.clock] { return clock.now_s(); }, std::move(nodes));
}

Result<std::unique_ptr<UsbDevice>> make_ds9490r(const UsbWish& wish, const UsbWorld& world) {
    AXISCAL_TRY(const double sensors, wish.number("sensors", "2"));
    AXISCAL_TRY(const double bits, wish.number("bits", "12"));
    if (!(sensors >= 1 && sensors <= 8) || !(bits >= 9 && bits <= 12))
        return fail(Fault::bad_request, "sensors are 1 to 8, bits 9 to 12");
    auto bus = std::make_unique<OneWireBus>();
    for (int sensor = 1; sensor <= static_cast<int>(sensors); ++sensor) {
        auto celsius = [thermal = world.scenario.thermal, clock = world.clock] {
            return material_at(thermal, clock.now_s()).in_celsius();
        };
        bus->add(std::make_unique<Ds18b20Chip>(static_cast<std::uint64_t>(sensor),
                                               static_cast<int>(bits), std::move(celsius)));
    }
    return std::make_unique<Ds9490rDevice>(std::move(bus));
}

} // namespace axiscal::simulate
