#include "wire/simulated_device.hpp"

#include "seeded_noise.hpp"

namespace axiscal::simulate {

Result<void> SimulatedDevice::behave(const std::string& word) {
    if (word == "on") return behave(Behaviour::on), Result<void>{};
    if (word == "off") return behave(Behaviour::off), Result<void>{};
    if (word == "garbage") return behave(Behaviour::garbage), Result<void>{};
    if (word == "flood") return behave(Behaviour::flood), Result<void>{};
    return fail(Fault::bad_request,
                "a face can be on, off, garbage or flood, not \"" + word + "\"");
}

std::string garbage_bytes(std::uint64_t seed, std::uint64_t index) {
    const SeededNoise noise{seed};
    std::string bytes;
    for (std::uint64_t i = 0; i < 5; ++i) {
        std::uint64_t word = noise.bits(NoiseStream::garbage, 5 * index + i);
        for (int n = 0; n < 8; ++n, word >>= 8)
            bytes += static_cast<char>(word & 0xFF);
    }
    return bytes;
}

} // namespace axiscal::simulate
