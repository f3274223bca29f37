#pragma once
// The frames of a Lasertex HPI-3D and what its driver makes of them, for the tests of the driver.

#include "drivers/framing/byte_order.hpp"
#include "drivers/framing/checksum.hpp"
#include "tests/support/sample_recorder.hpp"

#include <algorithm>
#include <iterator>

namespace axiscal::lasertex_wire {

using Bytes = std::vector<std::byte>;

inline const std::string raw_keys =
    "position = \"raw\"\nwavelength = \"632.991 nm\"\nfastest = \"0.5 m/s\"\n";

inline Bytes sealed(Bytes frame, std::size_t size) {
    frame.resize(size - 1);
    frame.push_back(std::byte{crc8_nrsc5(frame)});
    return frame;
}
inline Bytes request(int command) {
    return sealed(bytes_of({0xAA, 0xB0, command}), 8);
}
inline Bytes acknowledgement(int command) {
    return sealed(bytes_of({0xAA, 0xB0, command}), 16);
}
/// Below 2^24 steps of 100 pm. `signal`: 9 as it should be, 1 too weak.
inline Bytes distance(int steps, int signal = 9) {
    return sealed(bytes_of({0xAA, 0xB0, 0x15, 0, 0, 0, 0, steps >> 16 & 0xFF, steps >> 8 & 0xFF,
                            steps & 0xFF, 0, 0, 0, signal, 0x50}),
                  16);
}

inline std::vector<Sample> positions(const testing::SampleRecorder& sink) {
    std::vector<Sample> found;
    std::ranges::copy_if(sink.samples, std::back_inserter(found),
                         [](const Sample& sample) { return sample.channel == 0; });
    return found;
}

} // namespace axiscal::lasertex_wire
