#include "wire/serial_cable.hpp"

#include <thread>

namespace axiscal::simulate {

Result<std::unique_ptr<SerialCable>> SerialCable::open(const std::string& a, const std::string& b) {
    AXISCAL_TRY(Pty one, Pty::open(a));
    AXISCAL_TRY(Pty other, Pty::open(b));
    return std::unique_ptr<SerialCable>{new SerialCable{std::move(one), std::move(other)}};
}

void SerialCable::run(const std::stop_token& stop) {
    std::jthread back{[this](const std::stop_token& end) {
        while (!end.stop_requested())
            if (const auto bytes = b_.read(std::chrono::milliseconds{20}); !bytes.empty())
                a_.write(bytes);
    }};
    while (!stop.stop_requested())
        if (const auto bytes = a_.read(std::chrono::milliseconds{20}); !bytes.empty())
            b_.write(bytes);
}

} // namespace axiscal::simulate
