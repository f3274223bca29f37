#pragma once
// The disk fails: nothing is acknowledged, and it is tried again until it takes records, as a new
// daemon would find it.

#include "acquisition/live/to_do.hpp"
#include "acquisition/measurement/measurement.hpp"
#include "analysis/quantity/result.hpp"
#include "drivers/loop/scheduler.hpp"

#include <string>

namespace axiscal {

class LatestTests;
class Recovery;

/// Loop-bound. Its tasks end with the loop, as those of the station that has it. One wait at a
/// time.
class DiskWait {
public:
    DiskWait(const MeasurementContext& context, LatestTests& tests);

    [[nodiscard]] bool goes_on() const { return waiting_; }
    /// What people were told of it; empty while the disk takes records.
    [[nodiscard]] DiskTrouble trouble() const { return waiting_ ? trouble_ : DiskTrouble{}; }
    /// For the test before the CNC, which goes on then or is closed. Once, however often it is
    /// asked for.
    void begin();
    /// For what an earlier daemon left. Waits from now on: until_taken_over() does it.
    /// @returns what people were told of it
    std::string begin_to_take_over(const Error& why);
    /// @param told  the same is not said again, however long it lasts
    /// @returns whether all was taken over; else the daemon ends
    Task<bool> until_taken_over(Recovery& recovery, std::string told);

private:
    Task<void> wait();
    /// What failed and what to do, without the fault's own sentence.
    [[nodiscard]] std::string text_of(const Error& error) const;
    /// The same, told behind `sentence`, and the way out apart.
    [[nodiscard]] DiskTrouble trouble_of(const std::string& sentence, const Error& error) const;

    MeasurementContext context_;
    LatestTests& tests_;
    bool waiting_ = false;
    DiskTrouble trouble_; ///< while it waits
};

} // namespace axiscal
