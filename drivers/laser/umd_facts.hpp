#pragma once
// What a uMD tells of itself in its low-speed slots, joined with what the station file states.
// Pure. Codes: see laser_umd.cpp for the document they cite.

#include "analysis/quantity/quantity.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace axiscal {

enum class UmdFamily : std::uint8_t { unknown, umd0, umd1, umd2 };
enum class UmdHead : std::uint8_t { heterodyne, homodyne };
/// How field 4 is to be read.
enum class UmdPhase : std::uint8_t {
    none,        ///< homodyne: always 0
    eight_bit,   ///< 1/256 count, subtracted
    masked,      ///< uMD1: 1/256 count, or an error mask
    truncated,   ///< uMD2 v3.15: 1/256 count, low byte only
    sixteen_bit, ///< 1/65536 count, subtracted
};

/// What the station file states; empty: the instrument is asked.
struct UmdSetup {
    Length wavelength; ///< in vacuum; of a laser
    double optical_fold = 2;
    /// One count of a scale. With it wavelength, fold and counts per cycle mean nothing, and the
    /// firmware counts A-quad-B: `head` is homodyne.
    std::optional<Length> resolution;
    std::optional<int> counts_per_cycle;
    std::optional<UmdHead> head;
    std::optional<UmdPhase> phase;
    int axis = 1;  ///< 1..3
    Speed fastest; ///< the axis cannot move faster
};

class UmdFacts {
public:
    explicit UmdFacts(const UmdSetup& setup)
        : setup_{setup} {}
    /// One record has passed with this low-speed slot.
    void learn(std::int64_t code, std::int64_t data);

    [[nodiscard]] UmdFamily family() const;
    [[nodiscard]] std::optional<double> rate_Hz() const { return rate_Hz_; }
    [[nodiscard]] std::optional<UmdHead> head() const;
    [[nodiscard]] std::optional<int> counts_per_cycle() const;
    [[nodiscard]] std::optional<UmdPhase> phase() const;
    /// Everything is known that turns counts into metres.
    [[nodiscard]] bool complete() const;
    /// Names the missing facts and the keys that state them.
    [[nodiscard]] std::string missing() const;
    /// "counts_per_cycle = 4 is configured, the instrument says 16"; empty when they agree.
    [[nodiscard]] std::string contradiction() const;
    [[nodiscard]] std::string model() const;    ///< "uMD2"
    [[nodiscard]] std::string firmware() const; ///< "264.07"; empty before code 10
    /// Metres per count, of a laser in vacuum; only when complete.
    [[nodiscard]] double metres_per_count() const;

private:
    [[nodiscard]] bool integer_numbering() const;

    UmdSetup setup_;
    std::optional<double> rate_Hz_;
    std::optional<std::int64_t> firmware_word_, flags_;
    std::optional<int> homodyne_axes_, told_counts_;
    int records_since_firmware_ = 0;
};

/// The position in counts, fraction included; empty when field 4 holds no phase here.
std::optional<double> umd_position(std::int64_t displacement, std::int64_t phase, UmdPhase format);

} // namespace axiscal
