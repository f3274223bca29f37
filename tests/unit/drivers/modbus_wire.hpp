#pragma once
// A Modbus line under virtual time and the slave at its far end. What is sent is made here,
// checksum and all, apart from what reads it. Tests only.

#include "drivers/wire/byte_link.hpp"
#include "tests/support/virtual_scheduler.hpp"

#include <algorithm>
#include <deque>
#include <functional>

namespace axiscal::testing {

using Bytes = std::vector<std::uint8_t>;

/// Bit by bit, from the polynomial: Modbus over serial line V1.02, 6.2.2.
inline Bytes with_checksum(Bytes frame) {
    unsigned sum = 0xFFFF;
    for (const auto byte : frame) {
        sum ^= byte;
        for (int bit = 0; bit < 8; ++bit)
            sum = (sum & 1U) != 0 ? sum >> 1U ^ 0xA001U : sum >> 1U;
    }
    frame.push_back(static_cast<std::uint8_t>(sum));
    frame.push_back(static_cast<std::uint8_t>(sum >> 8U));
    return frame;
}

/// The far end of a line: what was sent to it, and what it will have sent by when.
struct Wire {
    std::deque<std::pair<MonotonicTime, Bytes>> coming; ///< in the order of their time
    std::function<void(const Bytes&, MonotonicTime)> slave;
    int openings = 0;

    void send(MonotonicTime at, Bytes bytes) {
        const auto after =
            std::ranges::upper_bound(coming, at, {}, [](auto& one) { return one.first; });
        coming.insert(after, {at, std::move(bytes)});
    }
};

class WireLink final : public ByteLink {
public:
    WireLink(VirtualScheduler& scheduler, Wire& wire)
        : scheduler_{scheduler}
        , wire_{wire} {}
    Task<Result<TimedBytes>> read_some(MonotonicTime deadline) override {
        while (wire_.coming.empty() || wire_.coming.front().first > scheduler_.now()) {
            if (scheduler_.now() >= deadline) co_return fail(Fault::link_timeout, "silence");
            co_await scheduler_.sleep_until(
                wire_.coming.empty() ? deadline : std::min(deadline, wire_.coming.front().first));
        }
        TimedBytes some{{}, scheduler_.now()};
        for (; !wire_.coming.empty() && wire_.coming.front().first <= scheduler_.now();
             wire_.coming.pop_front())
            for (const auto byte : wire_.coming.front().second)
                some.bytes.push_back(std::byte{byte});
        co_return some;
    }
    Task<Result<void>> write_all(std::vector<std::byte> bytes, MonotonicTime) override {
        Bytes request;
        for (const std::byte byte : bytes)
            request.push_back(std::to_integer<std::uint8_t>(byte));
        wire_.slave(request, scheduler_.now());
        co_return Result<void>{};
    }

private:
    VirtualScheduler& scheduler_;
    Wire& wire_;
};

class WireOpener final : public LinkOpener {
public:
    WireOpener(VirtualScheduler& scheduler, Wire& wire)
        : scheduler_{scheduler}
        , wire_{wire} {}
    Task<Result<std::unique_ptr<ByteLink>>> open(const LinkSettings&, MonotonicTime) override {
        ++wire_.openings;
        co_return std::make_unique<WireLink>(scheduler_, wire_);
    }

private:
    VirtualScheduler& scheduler_;
    Wire& wire_;
};

} // namespace axiscal::testing
