#pragma once
// The CNC is the master of a serial line, we are a slave on it. RTU frames are divided by silence,
// so libmodbus waits for them on a thread of its own.

#include "drivers/trigger/rtu_mailbox.hpp"
#include "drivers/trigger/trigger_server.hpp"

#include <thread>

namespace axiscal {

/// The port itself is loop-bound. The thread owns the line; it posts writes to the loop, waits a
/// bounded time until they are in the image it answers from, and opens the line again after an
/// error.
class ModbusRtuPort final : public MappedPort {
public:
    ModbusRtuPort(std::unique_ptr<RegisterMap> map, TriggerConfig config);
    ~ModbusRtuPort() override;
    ModbusRtuPort(const ModbusRtuPort&) = delete;
    ModbusRtuPort& operator=(const ModbusRtuPort&) = delete;
    Task<Result<void>> run(TriggerContext context) override;
    [[nodiscard]] std::string describe() const override;

private:
    void start(const TriggerContext& context);
    void stop(); ///< waits for the thread: one receive time-out at most

    std::shared_ptr<RtuMailbox> mailbox_; ///< shared with the thread and its posts
    std::thread thread_;
};

} // namespace axiscal
