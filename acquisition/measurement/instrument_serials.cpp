#include "acquisition/measurement/instrument_serials.hpp"

#include "acquisition/live/supervisor.hpp"

#include <cstddef>
#include <string>

namespace axiscal {

std::vector<InstrumentSerial> answered_serials(const Supervisor& instruments,
                                               const std::vector<int>& channels) {
    std::vector<InstrumentSerial> answered;
    for (const int id : channels) {
        const StationChannel& channel = instruments.channels()[static_cast<std::size_t>(id)];
        const std::string& serial = instruments.identity(channel.instrument).serial;
        if (!serial.empty()) answered.push_back({channel.instrument_name, serial});
    }
    return answered;
}

} // namespace axiscal
