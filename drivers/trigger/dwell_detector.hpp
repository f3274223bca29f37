#pragma once
// Capture by standing still, for machines that cannot ask: ARMED -> IN_WINDOW -> STABLE (request)
// -> LEAVE -> ARMED. Pure.

#include "analysis/quantity/time.hpp"

#include <cstdint>
#include <deque>
#include <optional>

namespace axiscal {

struct DwellLimits {
    double window_mm = 0.5;           ///< |position - target| at most this
    double stability_range_mm = 1e-3; ///< max - min over the period at most this
    Duration stability_period = std::chrono::milliseconds{500};
    Duration minimum_halt = std::chrono::seconds{1}; ///< in the window, before a request
    double hysteresis_mm = 0.1;                      ///< beyond the window, to count as having left
};

class DwellDetector {
public:
    enum class State : std::uint8_t { off, armed, in_window, requested, leave };

    explicit DwellDetector(const DwellLimits& limits)
        : limits_{limits} {}

    /// The next target; the same value again changes nothing. Empty: nothing to capture. While a
    /// request is open or the last target is not yet left, it is kept for afterwards.
    void aim(std::optional<double> target_mm);
    /// @returns true when the axis has halted at the target: one request is then open until
    /// finished() or failed(). A hole in the stream longer than a quarter of the period proves
    /// nothing: the halt begins anew.
    bool position(MonotonicTime at, double position_mm);
    /// The request has its point: the axis must leave the window before the next one, so that the
    /// two visits of a reversal are told apart.
    void finished();
    /// The request has no point. `try_again`: the same halt may still do, after another minimum
    /// halt; else the axis must leave and come back.
    void failed(bool try_again);
    /// A new run: whatever was open is forgotten.
    void reset();
    [[nodiscard]] State state() const { return state_; }

private:
    struct Reading {
        MonotonicTime at;
        double position_mm = 0;
        std::uint64_t number = 0; ///< since it entered the window
    };
    void enter(Reading reading);
    void arm();
    void keep(Reading reading);
    void forget_before(MonotonicTime begin);
    [[nodiscard]] bool still(MonotonicTime now) const;
    [[nodiscard]] bool within(double target_mm, double position_mm, double margin_mm) const;

    DwellLimits limits_;
    State state_ = State::off;
    std::optional<double> target_mm_;
    double left_target_mm_ = 0; ///< the target to be left, or of the open request
    bool gone_ = false;         ///< the axis left while the request was open
    MonotonicTime entered_at_;
    std::deque<Reading> recent_; ///< back to one reading at or before the period's begin
    /// Of recent_ what is lower (higher) than all after it: the first is the lowest (highest) of
    /// all, and a reading costs the same however many there are.
    std::deque<Reading> lows_, highs_;
};

} // namespace axiscal
