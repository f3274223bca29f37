#pragma once
// The µMD laser counter's records, written from the table of its firmware's fields: ASCII decimal
// integers, one space between, CR LF. 8 fields, or 16 with two more axes. No checksum.

#include "scenario.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace axiscal::simulate {

/// One record, in wire order. Pure data.
struct UmdRecord {
    std::int64_t reference = 0, measured = 0, displacement = 0, velocity = 0, phase = 0;
    std::int64_t sequence = 0, low_speed_code = 0, low_speed_data = 0;
    /// MEAS2 DISP2 VEL2 PHASE2 MEAS3 DISP3 VEL3 PHASE3
    std::optional<std::array<std::int64_t, 8>> further_axes;
};
std::string encode(const UmdRecord& record);

/// Error mask that µMD1 sends in place of the phase: no MEAS edge (beam blocked).
inline constexpr int umd1_no_measured_edge = 0x800;

/// The counter board: exact counts in, records out. One thread.
/// Heterodyne: DISP is the next whole count above and PHASE the fraction to subtract.
/// A lost beam makes a heterodyne counter run away by REF a sample with MEAS = 0; a homodyne one
/// stands still and tells nobody. Either way the position is lost when the beam comes back.
class UmdCounter {
public:
    explicit UmdCounter(LaserScenario laser);
    UmdRecord next(double cycles);
    void set_beam(bool on) { beam_ = on; }
    void restart();                                      ///< SEQ goes back to 1, DISP to 0
    void skip(std::int64_t records) { skip_ = records; } ///< SEQ jumps: the USB buffer was full
    void set_fields(int fields) { fields_ = fields; }
    void set_error_mask(int mask) { mask_ = mask; } ///< µMD1 only; 0: none
    [[nodiscard]] double rate_hz() const { return rate_hz_; }
    [[nodiscard]] std::int64_t sequence() const { return sequence_; } ///< of the last record
    [[nodiscard]] bool heterodyne() const { return heterodyne_; }

private:
    void follow(double counts, UmdRecord& record);
    void run_without_beam(double counts, UmdRecord& record);
    void add_low_speed(UmdRecord& record) const;
    [[nodiscard]] std::int64_t version_word() const;

    LaserScenario laser_;
    bool heterodyne_, beam_ = true;
    double rate_hz_, offset_counts_ = 0;
    std::int64_t reference_, sequence_ = 0, displacement_ = 0, skip_ = 0;
    int fields_, mask_ = 0;
};

} // namespace axiscal::simulate
