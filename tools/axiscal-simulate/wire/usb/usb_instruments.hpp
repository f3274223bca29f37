#pragma once
// Instruments that are USB devices of their own, as the command line wishes them.

#include "wire/usb/usb_kinds.hpp"

namespace axiscal::simulate {

/// Dracal USBTenki with the scenario's air. Setting: serial.
Result<std::unique_ptr<UsbDevice>> make_usbtenki(const UsbWish& wish, const UsbWorld& world);
/// LabJack U6. Settings: serial (a number); at its input volts + swing sin(2 pi t / period_s).
Result<std::unique_ptr<UsbDevice>> make_labjack_u6(const UsbWish& wish, const UsbWorld& world);
/// TEMPer whose probe touches the scenario's material, stick in its air. Setting: firmware.
Result<std::unique_ptr<UsbDevice>> make_temper(const UsbWish& wish, const UsbWorld& world);
/// CAN adapter with a transducer (node 127, at `mm`) and a thermometer (node 125) on its bus.
/// Setting: serial.
Result<std::unique_ptr<UsbDevice>> make_gs_usb(const UsbWish& wish, const UsbWorld& world);
/// 1-Wire adapter with DS18B20 thermometers on the scenario's material, 28-000000000001 and on.
/// Settings: sensors (1 to 8), bits (9 to 12).
Result<std::unique_ptr<UsbDevice>> make_ds9490r(const UsbWish& wish, const UsbWorld& world);

} // namespace axiscal::simulate
