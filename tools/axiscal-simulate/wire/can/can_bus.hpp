#pragma once
// CANopen devices on a CAN interface of this computer (vcan, or a real one), and what else can be
// on a bus: strangers who flood it. Commands from any thread; the devices live on one of their own.

#include "wire/can/can_node.hpp"
#include "wire/usb/usb_kinds.hpp"

#include <atomic>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

namespace axiscal::simulate {

class CanBus {
public:
    /// Each wish is KIND,name=value,...: cantrans or temposonics, `called`, `node`.
    /// @errors bad_request, io.
    static Result<std::unique_ptr<CanBus>> open(const std::string& interface,
                                                const std::vector<std::string>& wishes,
                                                const UsbWorld& world);
    CanBus() = default;
    ~CanBus();
    CanBus(const CanBus&) = delete;
    CanBus& operator=(const CanBus&) = delete;

    /// status, off NAME, on NAME, reset NAME, fault NAME, mend NAME, spoil NAME cut N|corrupt MASK|
    /// none, flood HZ, quit.
    nlohmann::json command(const std::string& line);
    [[nodiscard]] nlohmann::json status();
    [[nodiscard]] bool ended() const { return ended_; }

private:
    struct Device {
        std::string called, kind;
        std::unique_ptr<CanNode> node;
        std::shared_ptr<std::atomic<bool>> faulty; ///< of what it measures
        std::size_t longest = 8;                   ///< its frames lose all beyond
        std::uint8_t mask = 0;                     ///< each byte that it sends is XORed
    };
    Result<Device> make_device(const UsbWish& wish, const UsbWorld& world);
    Result<void> obey(const std::string& word, std::istream& arguments);
    void fault(Device& device, bool begins);
    static Result<void> spoil(Device& device, std::istream& arguments);
    static std::vector<CanMessage> spoilt(const Device& device, std::vector<CanMessage> frames);
    void live(const std::stop_token& stop);
    void look(double until_s);
    void flood(double now_s);
    void send(const std::vector<CanMessage>& frames);

    int socket_ = -1;
    SimClock clock_;
    std::mutex mutex_; ///< guards what follows
    std::vector<Device> devices_;
    double flood_hz_ = 0, flooded_until_s_ = 0;
    std::uint64_t foreign_ = 0, refused_ = 0; ///< frames sent; frames that the bus did not take
    std::atomic<bool> ended_{false};
    std::jthread thread_; ///< last: joined first
};

} // namespace axiscal::simulate
