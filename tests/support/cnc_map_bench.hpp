#pragma once
// Register maps on the bench: requests as bytes, and `done` set without a journal. Tests only.

#include "drivers/trigger/coil_and_index_map.hpp"
#include "drivers/trigger/sequence_block_map.hpp"
#include "drivers/trigger/single_register_map.hpp"

#include <initializer_list>

namespace axiscal::testing {

/// Opens `finish`, which the product reaches only with a JournalReceipt.
template <class Map> class MapBench : public Map {
public:
    using Map::finish;
    using Map::finish_skip;
    using Map::Map;

    MapNews write_word(int address, std::uint16_t value, MonotonicTime at = {}) {
        return this->write(ModbusRequest{modbus_function::write_register, 0, 0, address, {value}},
                           at);
    }
    MapNews
    write_words(int address, std::initializer_list<std::uint16_t> values, MonotonicTime at = {}) {
        return this->write(ModbusRequest{modbus_function::write_registers, 0, 0, address, values},
                           at);
    }
    MapNews write_coil(bool high, MonotonicTime at = {}) {
        const std::uint16_t value = high ? 1 : 0;
        return this->write(ModbusRequest{modbus_function::write_coil, 0, 0, 0, {value}}, at);
    }
    [[nodiscard]] std::uint16_t word(int address) const {
        return this->image().holding[static_cast<std::size_t>(address)];
    }
};

/// Answers every request as a run would whose points all succeed.
template <class Map> class Acknowledging : public MapBench<Map> {
public:
    using MapBench<Map>::MapBench;
    MapNews write(const ModbusRequest& request, MonotonicTime at) override {
        return finish_all(MapBench<Map>::write(request, at));
    }
    MapNews tick(MonotonicTime now) override { return finish_all(MapBench<Map>::tick(now)); }

private:
    MapNews finish_all(MapNews news) {
        for (const auto& event : news.events)
            this->finish(event.sequence);
        return news;
    }
};

} // namespace axiscal::testing
