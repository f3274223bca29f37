#pragma once
// A CANopen device as the wire sees it: object dictionary, SDO server, network management,
// heartbeat or node guarding, emergency, TPDOs by time. A model: who carries its frames is not its
// business. All of one node on one thread.
//
// Written from CiA 301 V4.2.

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace axiscal::simulate {

/// A frame with an 11-bit identifier.
struct CanMessage {
    std::uint32_t id = 0;
    std::vector<std::uint8_t> data; ///< at most 8; none of a remote frame
    bool remote = false;            ///< asks for the frame of this identifier
};

class CanNode {
public:
    using Bytes = std::vector<std::uint8_t>;
    using Measured = std::function<Bytes(double seconds)>;
    explicit CanNode(int node)
        : node_{static_cast<std::uint32_t>(node)} {}

    /// The dictionary, before power comes on. Numbers have the low byte first.
    void put_number(int index, int sub, std::uint32_t value, int bytes, bool writable = false);
    void put_text(int index, int sub, const std::string& text);
    void put_measured(int index, int sub, Measured value);
    /// TPDO `number` with its parameters (0x1800) and its mapping (0x1A00).
    void put_tpdo(int number,
                  std::uint32_t id,
                  int transmission,
                  int event_ms,
                  const std::vector<std::uint32_t>& mapping);

    /// Answers remote frames for its state, as a node does that has no heartbeat (7.2.8.3.2.1).
    void put_guarding() { guarded_ = true; }

    void power_on(double now_s);
    void power_off() { state_ = off; }
    /// Answers to one frame of the bus.
    std::vector<CanMessage> take(const CanMessage& frame, double now_s);
    /// What it sends by itself until now. A real device sends in time or not at all: what was due
    /// more than 20 ms ago, because this computer stood still, is skipped and counted.
    std::vector<CanMessage> advance(double now_s);
    [[nodiscard]] double next_due_s() const; ///< infinity: nothing by itself
    /// An emergency message, sent with the next advance().
    void tell_emergency(std::uint16_t code, std::uint8_t error_register, const Bytes& maker);
    [[nodiscard]] std::uint64_t pdos_sent() const { return pdos_sent_; }
    /// Thread-safe.
    [[nodiscard]] std::uint64_t pdos_skipped() const { return pdos_skipped_; }
    [[nodiscard]] int number() const { return static_cast<int>(node_); }

private:
    enum State { off = -1, stopped = 4, operational = 5, pre_operational = 0x7F };
    struct Object {
        Bytes value;
        Measured measured;
        bool writable = false;
    };
    using Key = std::pair<int, int>;
    struct Upload {
        Bytes content;
        std::size_t sent = 0;
        std::uint8_t toggle = 0;
    };
    [[nodiscard]] std::uint32_t number_at(int index, int sub) const;
    [[nodiscard]] Bytes content(const Object& object, double now_s) const;
    void obey(const CanMessage& frame, double now_s);
    void enter(State state, double now_s);
    void reset_communication(double now_s);
    CanMessage serve(const CanMessage& request, double now_s);
    CanMessage begin_upload(Key key, double now_s);
    CanMessage next_segment(std::uint8_t command);
    CanMessage download(const CanMessage& request, Key key, double now_s);
    [[nodiscard]] CanMessage abort(Key key, std::uint32_t code) const;
    [[nodiscard]] CanMessage answer(Bytes bytes) const;
    void send_pdos(double now_s, std::vector<CanMessage>& sent);
    [[nodiscard]] CanMessage pdo(int number, double now_s) const;
    void plan(double now_s);
    [[nodiscard]] double pdo_period_s(int number) const; ///< 0: not by itself

    std::uint32_t node_;
    State state_ = off;
    bool guarded_ = false;
    std::uint8_t guard_toggle_ = 0; ///< of the next answer
    std::map<Key, Object> objects_, delivered_;
    Upload upload_;
    std::vector<CanMessage> waiting_; ///< boot-up, emergencies
    std::map<int, double> next_pdo_s_;
    double next_beat_s_ = 0;
    std::uint64_t pdos_sent_ = 0;
    std::atomic<std::uint64_t> pdos_skipped_{0};
};

/// The lowest `bytes` (0 to 8) of a number as the bus carries them; negative: two's complement.
CanNode::Bytes low_byte_first(std::int64_t value, int bytes);

} // namespace axiscal::simulate
