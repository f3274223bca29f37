#pragma once
// single-register: holding 0 is the request, input register 0 the last one finished. Pure.

#include "drivers/trigger/register_map.hpp"

namespace axiscal {

class SingleRegisterMap : public RegisterMap {
public:
    [[nodiscard]] AddressSpace space() const override;
    [[nodiscard]] RegisterImage image() const override;
    MapNews write(const ModbusRequest& request, MonotonicTime at) override;
    MapNews tick(MonotonicTime now) override;
    void arm() override;
    void end_run(RunEnd end) override;
    /// Nothing to show: the CNC holds until its own time-out.
    void refuse(std::uint16_t sequence, Fault fault) override;
    void show(const PortStatus& status) override;

protected:
    void finish(std::uint16_t sequence) override { done_ = sequence; }

private:
    std::optional<std::uint16_t> last_request_; ///< empty: none seen since the start
    std::uint16_t done_ = no_run_sequence;
    bool armed_ = false;
};

} // namespace axiscal
