#pragma once
// A Dracal USBTenki stick with an MS5611 and an SHT31, as its open firmware answers (usbtenki, last
// revision 2020: main.c, usbtenki_cmds.h): vendor requests on endpoint 0. All of it on one thread.

#include "true_air.hpp"
#include "wire/usb/usb_device.hpp"

#include <array>
#include <functional>

namespace axiscal::simulate {

/// C1..C6 of the MS5611's memory; the default is the data sheet's example.
using Ms5611Words = std::array<std::uint16_t, 6>;
inline constexpr Ms5611Words ms5611_example{40127, 36924, 23317, 23282, 33464, 28312};

struct Ms5611Counts {
    std::uint32_t d1 = 0, d2 = 0; ///< pressure and temperature conversion, 24 bits
};
/// The conversions that the data sheet's equations turn back into this air, to half a step. Pure.
Ms5611Counts ms5611_counts(double pressure_Pa, double temperature_degC, const Ms5611Words& words);

class UsbTenkiDevice final : public UsbDevice {
public:
    /// @param air  asked at every reading.
    UsbTenkiDevice(std::string serial, std::function<TrueAir()> air);

    [[nodiscard]] const UsbDescriptors& descriptors() const override { return descriptors_; }
    UsbAnswer control(const UsbSetup& setup, std::span<const std::uint8_t> data) override;

private:
    [[nodiscard]] Bytes raw(int channel) const;
    [[nodiscard]] Bytes calibration(int index) const;

    UsbDescriptors descriptors_;
    std::function<TrueAir()> air_;
};

} // namespace axiscal::simulate
