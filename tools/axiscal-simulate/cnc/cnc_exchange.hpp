#pragma once
// The Modbus side of the CNC: as client of the daemon (libmodbus, TCP or RTU), or as a server that
// the daemon polls. run() owns its thread; comes back by itself after a lost connection.

#include "cnc/cnc_lines.hpp"
#include "sim_clock.hpp"
#include "wire/tcp_slave.hpp"

#include <atomic>
#include <memory>
#include <stop_token>

namespace axiscal::simulate {

class CncExchange {
public:
    virtual ~CncExchange() = default;
    virtual void run(std::stop_token stop) = 0;
    [[nodiscard]] virtual bool connected() const = 0;
    [[nodiscard]] virtual int port() const = 0; ///< ours as a server, theirs as a client
};

/// Where a client finds the daemon; may change while running.
struct DaemonAddress {
    std::string host;
    int port = 0;
};

class CncClient final : public CncExchange {
public:
    CncClient(CncScenario cnc, CncLines& lines, SimClock clock);
    void run(std::stop_token stop) override;
    [[nodiscard]] bool connected() const override { return connected_; }
    [[nodiscard]] int port() const override;
    void redirect(DaemonAddress address);

private:
    struct Line;
    [[nodiscard]] std::unique_ptr<Line> connect();
    bool pass(Line& line);
    bool write_due(Line& line);
    bool read_answer(Line& line);
    bool beat(Line& line);

    CncScenario cnc_;
    CncLines& lines_;
    SimClock clock_;
    mutable std::mutex address_mutex_;
    DaemonAddress address_;
    std::atomic<bool> connected_{false}, redirected_{false};
    double next_beat_s_ = 0;
    std::uint16_t beat_ = 0;
};

/// The mirrored sequence-block: FC 3 and 16 only, as a FANUC answers.
class CncServer final : public CncExchange {
public:
    static Result<std::unique_ptr<CncServer>>
    open(CncScenario cnc, CncLines& lines, SimClock clock);
    void run(std::stop_token stop) override;
    [[nodiscard]] bool connected() const override { return heard_; }
    [[nodiscard]] int port() const override { return slave_->port(); }

private:
    CncServer(CncScenario cnc, CncLines& lines, SimClock clock);
    Bytes answer(std::span<const std::uint8_t> pdu);
    void refresh();

    CncScenario cnc_;
    CncLines& lines_;
    SimClock clock_;
    RegisterBank bank_;
    std::unique_ptr<TcpSlave> slave_;
    std::atomic<bool> heard_{false};
};

} // namespace axiscal::simulate
