#pragma once
// coil-and-index: coil 0 triggers, holding 0 says which request it is. Pure.
//
// A client that writes its registers pass by pass may send the coil before the index of the same
// pass; the coil then rises over the number of the previous request (measured with mb2hal: 26 of
// 150). Such an edge waits for the index to be rewritten; only when it stays the same for the
// grace, the CNC really asks for the previous request again.

#include "drivers/trigger/register_map.hpp"

namespace axiscal {

class CoilAndIndexMap : public RegisterMap {
public:
    /// @param index_grace  longer than one pass of the client over its registers
    explicit CoilAndIndexMap(Duration index_grace)
        : index_grace_{index_grace} {}
    [[nodiscard]] AddressSpace space() const override;
    [[nodiscard]] RegisterImage image() const override;
    /// The event bears the arrival time of the coil, also when the index came later.
    MapNews write(const ModbusRequest& request, MonotonicTime at) override;
    MapNews tick(MonotonicTime now) override;
    /// The end of an undecided edge's grace.
    [[nodiscard]] std::optional<MonotonicTime> due() const override;
    void arm() override;
    void end_run(RunEnd end) override;
    /// Nothing to show: the acknowledge stays low and the CNC holds until its own time-out.
    void refuse(std::uint16_t sequence, Fault fault) override;
    void show(const PortStatus& status) override;

protected:
    /// The acknowledge rises only while the coil of this very request is still high.
    void finish(std::uint16_t sequence) override;

private:
    struct Edge {
        MonotonicTime at;
        bool standing = false;
    };
    void take_index(std::uint16_t index, MapNews& news);
    void take_coil(bool high, MonotonicTime at, MapNews& news);
    [[nodiscard]] bool index_is_fresh() const;
    void deliver(MapNews& news);

    Duration index_grace_;
    std::uint16_t index_ = 0, done_ = no_run_sequence;
    std::optional<std::uint16_t> delivered_; ///< index of the last edge reported
    std::optional<Edge> undecided_;
    std::optional<bool> coil_; ///< empty: not seen since the start
    bool acknowledge_ = false, armed_ = false;
};

} // namespace axiscal
