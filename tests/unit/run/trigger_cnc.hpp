#pragma once
// A CNC in virtual time: its part program, and the Modbus client that carries its outputs to the
// station and the station's answers back, as bytes that may be slow. What goes wrong is chosen by
// Mischief; nothing here knows what the station makes of it.

#include "trigger_shop.hpp"

namespace axiscal::testing {

/// What this sequence does to the station. The first six are the CNC's right or bad luck; the last
/// three break the contract.
enum class Kind : std::uint8_t {
    doubled,
    repeated,
    late,
    stale_coil,
    slow_client,
    daemon_restart,
    missed,
    out_of_order,
    restarted_counter
};

struct Mischief {
    std::set<Kind> kinds;
    int breaks_at = -1; ///< point at which the contract is broken
    [[nodiscard]] bool does(Kind kind) const { return kinds.contains(kind); }
};

/// One TCP connection: bytes keep their order and die with either end.
struct Connection {
    int life = 0; ///< the daemon's
    MbapFramer framer;
    MonotonicTime last_byte;
    std::uint16_t transaction = 0;
};

/// What the program reads.
struct Answers {
    std::uint16_t done = 0xffff;
    bool acknowledge = false;
};

class Cnc {
public:
    Cnc(Station& with, Mischief what)
        : station_{with}
        , clock_{with.clock}
        , dice_{with.dice}
        , axis_{with.axis}
        , mischief_{std::move(what)}
        , cyclic_{dice_.one_in(2)}
        , coil_shape_{with.shape == TriggerShape::coil_and_index} {
        for (std::size_t step = 0; step < with.setup.plan.points.size(); ++step)
            errors_.push_back(um(dice_.between(-40, 40)));
        axis_.place = with.setup.plan.datum;
        if (mischief_.does(Kind::stale_coil) || dice_.one_in(4)) { // of the program before
            number_ = static_cast<std::uint16_t>(dice_.between(1, 110));
            coil_ = coil_shape_ && dice_.one_in(2);
        }
        pass();
        clock_.after(dice_.span(500, 3000), [this] { begin(); });
    }

    [[nodiscard]] bool at_end() const { return phase_ == Phase::ended; }
    [[nodiscard]] bool held() const { return phase_ == Phase::held; }
    [[nodiscard]] const std::vector<Length>& errors() const { return errors_; }
    std::string broken_promise; ///< the CNC was let go before its point was on disk

private:
    enum class Phase : std::uint8_t { idle, arming, moving, asking, lowering, ended, held };

    // --- the part program ---

    void begin() {
        number_ = 0;
        coil_ = false;
        enter(Phase::arming, std::chrono::seconds{600});
    }

    void go_on() {
        ++point_;
        if (point_ == mischief_.breaks_at && mischief_.does(Kind::missed)) ++point_, ++request_;
        if (point_ >= points()) return enter(Phase::ended, {});
        request_ = next_sequence(request_);
        if (point_ == mischief_.breaks_at) break_contract();
        asked_again_ = false;
        if (coil_shape_ && !dice_.one_in(3)) number_ = request_; // long before the coil
        move();
    }

    void break_contract() {
        if (mischief_.does(Kind::restarted_counter)) request_ = 1;
        if (!mischief_.does(Kind::out_of_order)) return;
        const bool old = point_ >= 4 && dice_.one_in(2);
        request_ = static_cast<std::uint16_t>(old ? dice_.between(2, point_ - 1)
                                                  : dice_.between(point_ + 2, 1000));
    }

    void move() {
        enter(Phase::moving, {});
        axis_.moving = true;
        const int of = ++visit_;
        clock_.after(dice_.span(200, 1500), [this, of] {
            if (of != visit_) return;
            axis_.moving = false;
            axis_.still_since = clock_.now();
            axis_.place = target() + errors_[static_cast<std::size_t>(point_)];
            clock_.after(dice_.span(100, 700), [this, of] {
                if (of == visit_ && phase_ == Phase::moving) ask();
            });
        });
    }

    void ask() {
        number_ = request_;
        coil_ = coil_shape_;
        enter(Phase::asking, answer_limit);
        if (mischief_.does(Kind::doubled))
            for (int i = dice_.between(1, 4); i > 0; --i)
                clock_.after(dice_.span(0, 2500), [this] { write_all(); });
        if (mischief_.does(Kind::late)) send_ghost();
        if (mischief_.does(Kind::repeated) && dice_.one_in(3)) deaf_until_ = again_in(300, 4000);
        if (mischief_.does(Kind::daemon_restart) && dice_.one_in(3))
            clock_.after(dice_.span(0, 2500), [this] {
                if (station_.open && !station_.closed) station_.die(dice_.span(300, 8000));
            });
    }

    MonotonicTime again_in(int low_ms, int high_ms) {
        const auto until = clock_.now() + dice_.span(low_ms, high_ms);
        clock_.at(until, [this, of = visit_] {
            if (of == visit_ && phase_ == Phase::asking) take_back();
        });
        return until;
    }

    /// Takes the request back and asks the same again, as docs/trigger.md says.
    void take_back() {
        number_ = coil_shape_ ? number_ : std::uint16_t{0};
        coil_ = false;
        write_all();
        clock_.after(dice_.span(150, 600), [this, of = visit_] {
            if (of == visit_ && phase_ == Phase::asking) number_ = request_, coil_ = coil_shape_;
        });
    }

    void answered() {
        ++visit_;
        const auto& points = station_.disk.points;
        const auto found = std::ranges::find(points, point_, &PointRecord::step);
        if (mischief_.breaks_at < 0 && found == points.end())
            broken_promise = "let go of point " + std::to_string(point_ + 1);
        if (!coil_shape_) return go_on();
        enter(Phase::lowering, answer_limit);
        const auto drop = [this, of = visit_] {
            if (of == visit_) coil_ = false;
        };
        if (mischief_.does(Kind::stale_coil))
            clock_.after(dice_.span(0, 6000), drop);
        else
            drop();
    }

    void enter(Phase phase, Duration limit) {
        phase_ = phase;
        if (limit <= Duration{}) return;
        clock_.after(limit, [this, of = visit_, phase] {
            if (of == visit_ && phase_ == phase) out_of_patience();
        });
    }

    void out_of_patience() {
        if (phase_ != Phase::asking || asked_again_) return enter(Phase::held, {});
        asked_again_ = true;
        number_ = coil_shape_ ? number_ : std::uint16_t{0};
        coil_ = false;
        write_all();
        move();
    }

    void hear(const Answers& answers) {
        if (phase_ == Phase::arming && answers.done == 0) go_on();
        if (phase_ == Phase::asking && clock_.now() >= deaf_until_ && number_ == request_ &&
            (coil_shape_ ? answers.acknowledge && coil_ : answers.done == request_))
            answered();
        if (phase_ == Phase::lowering && !answers.acknowledge && !coil_) go_on();
    }

    // --- the Modbus client ---

    void pass() {
        if (phase_ == Phase::ended || phase_ == Phase::held) return;
        connect();
        if (connection_) {
            if (cyclic_ || number_ != written_number_ || coil_ != written_coil_) write_all();
            if (!reading_) read();
        }
        const bool slow = mischief_.does(Kind::slow_client);
        clock_.after(dice_.span(slow ? 800 : 40, slow ? 2500 : 160), [this] { pass(); });
    }

    /// A new connection begins with everything the CNC stands at.
    void connect() {
        if (connection_ && connection_->life == station_.life) return;
        connection_.reset();
        reading_ = false;
        if (!station_.open) return;
        connection_ = std::make_shared<Connection>();
        connection_->life = station_.life;
        write_all();
    }

    void write_all() {
        if (!connection_) return;
        written_number_ = number_;
        written_coil_ = coil_;
        const bool coil_first = coil_shape_ && dice_.one_in(2);
        if (coil_first) send_coil();
        if (station_.shape == TriggerShape::sequence_block)
            send(connection_, block());
        else
            send(connection_, {6, 0, 0, high(number_), low(number_)});
        if (coil_shape_ && !coil_first) send_coil();
    }
    void send_coil() {
        send(connection_, {5, 0, 0, static_cast<std::uint8_t>(coil_ ? 0xff : 0), 0});
    }

    [[nodiscard]] Bytes block() const {
        const auto& planned =
            station_.setup.plan
                .points[static_cast<std::size_t>(std::clamp(point_, 0, points() - 1))];
        const auto counts = static_cast<std::uint32_t>(std::lround(target().in(um)*10));
        const std::uint16_t way = planned.direction == Direction::positive ? 1 : 2;
        Bytes pdu{16, 0, 1, 0, 7, 14};
        for (const auto word :
             {std::uint16_t{2}, number_, static_cast<std::uint16_t>(planned.target_index), way,
              static_cast<std::uint16_t>(counts >> 16), static_cast<std::uint16_t>(counts),
              static_cast<std::uint16_t>(planned.approach)})
            pdu.insert(pdu.end(), {high(word), low(word)});
        return pdu;
    }

    /// The gateway delivers once more what was asked before, over a connection of its own.
    void send_ghost() {
        if (coil_shape_ || !dice_.one_in(3) || request_ < 3) return;
        auto other = std::make_shared<Connection>();
        other->life = station_.life;
        const auto old = static_cast<std::uint16_t>(request_ - dice_.between(1, 2));
        clock_.after(dice_.span(0, 3000), [this, other, old] {
            if (station_.shape == TriggerShape::sequence_block)
                send(other, {6, 0, 2, high(old), low(old)});
            else
                send(other, {6, 0, 0, high(old), low(old)});
        });
    }

    /// Bytes arrive in order, in lumps from a slow client.
    void send(const std::shared_ptr<Connection>& connection, const Bytes& pdu) {
        const Bytes frame = framed(++connection->transaction, pdu);
        const bool slow = mischief_.does(Kind::slow_client);
        const auto delay =
            mischief_.does(Kind::late) && dice_.one_in(4) ? dice_.span(0, 2500) : dice_.span(0, 5);
        auto when = std::max(clock_.now() + delay, connection->last_byte);
        const std::size_t lump =
            slow ? static_cast<std::size_t>(dice_.between(1, 5)) : frame.size();
        for (std::size_t from = 0; from < frame.size(); from += lump) {
            const auto end = std::min(from + lump, frame.size());
            clock_.at(when, [this, connection,
                             bytes = Bytes(frame.begin() + static_cast<std::ptrdiff_t>(from),
                                           frame.begin() + static_cast<std::ptrdiff_t>(end))] {
                arrive(connection, bytes);
            });
            if (slow) when += dice_.span(0, 30);
        }
        connection->last_byte = when;
    }

    void arrive(const std::shared_ptr<Connection>& connection, const Bytes& bytes) {
        if (connection->life != station_.life || !station_.open) return;
        connection->framer.feed(bytes);
        while (const auto frame = connection->framer.next()) {
            const auto image = station_.serve(*frame);
            const bool read = (*frame)[mbap_header] == 3 || (*frame)[mbap_header] == 4;
            if (image && read && connection == connection_) answer(*image);
        }
    }

    void read() {
        reading_ = true;
        if (station_.shape == TriggerShape::sequence_block)
            send(connection_, {3, 0, 18, 0, 15});
        else
            send(connection_, {4, 0, 0, 0, 1});
    }

    void answer(const RegisterImage& image) {
        Answers answers;
        answers.done = station_.shape == TriggerShape::sequence_block
                           ? image.holding[sequence_block::acknowledged_sequence]
                           : image.input[0];
        answers.acknowledge = image.discrete_inputs[0] != 0;
        const bool late = mischief_.does(Kind::late) && dice_.one_in(4);
        clock_.after(dice_.span(0, late ? 2500 : 5), [this, answers, from = connection_] {
            if (from != connection_) return;
            reading_ = false;
            hear(answers);
        });
    }

    static std::uint8_t high(std::uint16_t word) { return static_cast<std::uint8_t>(word >> 8); }
    static std::uint8_t low(std::uint16_t word) { return static_cast<std::uint8_t>(word); }
    [[nodiscard]] int points() const { return static_cast<int>(errors_.size()); }
    [[nodiscard]] Length target() const {
        const auto& plan = station_.setup.plan;
        const auto step = static_cast<std::size_t>(std::clamp(point_, 0, points() - 1));
        return plan.targets[static_cast<std::size_t>(plan.points[step].target_index)];
    }

    static constexpr Duration answer_limit = std::chrono::seconds{15};

    Station& station_;
    VirtualClock& clock_;
    Dice& dice_;
    Axis& axis_;
    Mischief mischief_;
    bool cyclic_, coil_shape_;
    std::vector<Length> errors_; ///< the axis's own, by step: the truth
    Phase phase_ = Phase::idle;
    int point_ = -1, visit_ = 0;
    std::uint16_t request_ = 0, number_ = 0, written_number_ = 0xffff;
    bool coil_ = false, written_coil_ = false, asked_again_ = false, reading_ = false;
    MonotonicTime deaf_until_;
    std::shared_ptr<Connection> connection_;
};

} // namespace axiscal::testing
