#pragma once
// Simulated USB devices as links, without a kernel between: the models of axiscal-simulate are the
// wire, virtual time is theirs. Tests only.

#include "drivers/wire/usb_link.hpp"
#include "tests/support/virtual_scheduler.hpp"
#include "wire/usb/usb_faults.hpp"

#include <algorithm>

namespace axiscal::testing {

/// One socket. The device is borrowed.
struct Socket {
    simulate::UsbDevice* device = nullptr;
    std::string port = "1-1";
    bool plugged = true;
    simulate::UsbFaults faults = {};
    int openings = 0;
};

/// What both kinds of link ask of a device.
class ModelWire {
public:
    ModelWire(Scheduler& scheduler, Socket& socket)
        : scheduler_{scheduler}
        , socket_{socket} {}

    /// Asks again every millisecond while the device says NAK.
    template <class Ask> Task<Result<TimedBytes>> transfer(Ask ask, MonotonicTime deadline) {
        for (;;) {
            if (!socket_.plugged) co_return fail(Fault::link_closed, "was unplugged");
            const bool mute = socket_.faults.fault() == simulate::UsbFault::mute;
            const bool stalls = socket_.faults.fault() == simulate::UsbFault::stall;
            const auto answer = mute     ? simulate::UsbAnswer::hold()
                                : stalls ? simulate::UsbAnswer::stall()
                                         : socket_.faults.spoil(ask(*socket_.device));
            if (answer.how == simulate::UsbAnswer::How::stall)
                co_return fail(Fault::refused, "STALL");
            if (answer.how == simulate::UsbAnswer::How::done) {
                const auto bytes = std::as_bytes(std::span{answer.bytes});
                TimedBytes came{{bytes.begin(), bytes.end()}, scheduler_.now()};
                co_return came;
            }
            if (scheduler_.now() >= deadline) co_return fail(Fault::link_timeout, "NAK");
            const MonotonicTime next =
                std::min(deadline, scheduler_.now() + std::chrono::milliseconds{1});
            co_await scheduler_.sleep_until(next);
        }
    }
    static std::vector<std::uint8_t> raw(const std::vector<std::byte>& bytes) {
        std::vector<std::uint8_t> numbers;
        for (const std::byte byte : bytes)
            numbers.push_back(std::to_integer<std::uint8_t>(byte));
        return numbers;
    }

private:
    Scheduler& scheduler_;
    Socket& socket_;
};

class ModelUsbLink final : public UsbLink {
public:
    ModelUsbLink(Scheduler& scheduler, Socket& socket)
        : wire_{scheduler, socket} {
        const auto& told = socket.device->descriptors();
        entry_.name = told.name;
        entry_.serial = told.serial;
        entry_.port = socket.port;
    }
    Task<Result<TimedBytes>> control_in(UsbRequest r, MonotonicTime deadline) override {
        simulate::UsbSetup setup;
        setup.request_type = static_cast<std::uint8_t>(r.request_type);
        setup.request = static_cast<std::uint8_t>(r.request);
        setup.value = static_cast<std::uint16_t>(r.value);
        setup.index = static_cast<std::uint16_t>(r.index);
        setup.length = static_cast<std::uint16_t>(r.length);
        auto ask = [setup](simulate::UsbDevice& device) { return device.control(setup, {}); };
        return wire_.transfer(std::move(ask), deadline);
    }
    Task<Result<void>>
    bulk_out(int endpoint, std::vector<std::byte> bytes, MonotonicTime deadline) override {
        auto ask = [endpoint, data = ModelWire::raw(bytes)](simulate::UsbDevice& device) {
            return device.out(static_cast<std::uint8_t>(endpoint), data);
        };
        const auto done = co_await wire_.transfer(std::move(ask), deadline);
        if (!done) co_return tl::unexpected<Error>(done.error());
        co_return Result<void>{};
    }
    Task<Result<TimedBytes>>
    bulk_in(int endpoint, std::size_t longest, MonotonicTime deadline) override {
        auto ask = [endpoint, longest](simulate::UsbDevice& device) {
            return device.in(static_cast<std::uint8_t>(endpoint & 0x7F), longest);
        };
        return wire_.transfer(std::move(ask), deadline);
    }
    Task<Result<TimedBytes>>
    next_packet(int endpoint, std::size_t longest, MonotonicTime deadline) override {
        return bulk_in(endpoint, longest, deadline);
    }
    [[nodiscard]] const UsbEntry& entry() const override { return entry_; }

private:
    ModelWire wire_;
    UsbEntry entry_;
};

/// HID by interface 1: SET_REPORT out, interrupt endpoint 2 in.
class ModelHidLink final : public ByteLink {
public:
    ModelHidLink(Scheduler& scheduler, Socket& socket)
        : wire_{scheduler, socket} {}
    Task<Result<TimedBytes>> read_some(MonotonicTime deadline) override {
        auto ask = [](simulate::UsbDevice& device) { return device.in(2, 8); };
        return wire_.transfer(ask, deadline);
    }
    Task<Result<void>> write_all(std::vector<std::byte> bytes, MonotonicTime deadline) override {
        auto ask = [data = ModelWire::raw(bytes)](simulate::UsbDevice& device) {
            const simulate::UsbSetup set_report{0x21, 0x09, 0x0200, 1,
                                                static_cast<std::uint16_t>(data.size())};
            return device.control(set_report, data);
        };
        const auto done = co_await wire_.transfer(std::move(ask), deadline);
        if (!done) co_return tl::unexpected<Error>(done.error());
        co_return Result<void>{};
    }

private:
    ModelWire wire_;
};

/// Chooses among its sockets as the real opener does among those of the computer.
class ModelPlug final : public LinkOpener {
public:
    explicit ModelPlug(Scheduler& scheduler)
        : scheduler_{scheduler} {}
    Task<Result<std::unique_ptr<ByteLink>>> open(const LinkSettings& settings,
                                                 MonotonicTime) override {
        const auto socket = choose(settings.usb);
        if (!socket) co_return tl::unexpected<Error>(socket.error());
        co_return std::make_unique<ModelHidLink>(scheduler_, **socket);
    }
    Task<Result<std::unique_ptr<UsbLink>>> open_usb(const LinkSettings& settings,
                                                    MonotonicTime) override {
        const auto socket = choose(settings.usb);
        if (!socket) co_return tl::unexpected<Error>(socket.error());
        co_return std::make_unique<ModelUsbLink>(scheduler_, **socket);
    }
    std::vector<Socket*> sockets;

private:
    Result<Socket*> choose(const UsbPlace& place) {
        std::vector<UsbEntry> plugged;
        for (const Socket* socket : sockets) {
            if (!socket->plugged) continue;
            const auto& told = socket->device->descriptors();
            plugged.push_back({told.vendor, told.product, told.its_class, 1, 1, socket->port,
                               told.name, told.serial});
        }
        AXISCAL_TRY(const UsbEntry entry, choose_usb(place, plugged));
        const auto found = std::ranges::find(sockets, entry.port, &Socket::port);
        if ((*found)->openings++ == 0) (*found)->device->plugged();
        return *found;
    }

    Scheduler& scheduler_;
};

} // namespace axiscal::testing
