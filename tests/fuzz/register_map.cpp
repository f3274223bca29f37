// A client that writes what it likes into each trigger shape. Steps of the input: a length byte, a
// PDU, a time step in 10 ms. `done` is never ours to move: no receipt is given here.

#include "drivers/trigger/register_map.hpp"
#include "tests/fuzz/judge.hpp"

using namespace axiscal;

namespace {

void judge(const MapNews& news) {
    for (const auto& event : news.events)
        fuzz::require(event.sequence != 0, "0 is the idle number, no request");
}

void play(RegisterMap& map, std::span<const std::uint8_t> steps) {
    MonotonicTime now{};
    while (steps.size() > 2) {
        const auto length = std::min<std::size_t>(steps[0], steps.size() - 2);
        const auto request = parse_modbus_request(steps.subspan(1, length));
        now += steps[length + 1] * std::chrono::milliseconds{10};
        if (steps[0] % 64 == 63) map.arm();
        if (request && map.space().check(*request) == ModbusException::none &&
            !request->values.empty())
            judge(map.write(*request, now));
        judge(map.tick(now));
        if (steps[0] % 32 == 31) map.refuse(steps[length + 1], Fault::wrong_target);
        auto image = map.image();
        image.stamp(now);
        steps = steps.subspan(length + 2);
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    for (const auto shape : {TriggerShape::sequence_block, TriggerShape::single_register,
                             TriggerShape::coil_and_index})
        for (const bool variant : {false, true}) {
            TriggerConfig config;
            config.shape = shape;
            config.low_word_first = config.watch_heartbeat = variant;
            play(*make_register_map(config), {data, size});
        }
    return 0;
}
