#pragma once
// Plays a tape on a wire that an unmodified program opens as its instrument. Loop-bound.

#include "drivers/recording/near_wire.hpp"
#include "drivers/recording/tape_link.hpp"

namespace axiscal {

struct TapePace {
    bool fast = false; ///< without waiting; else each transfer in its time after what came before
};

/// Plays all entries in order. What the other side must write is waited for; what follows comes as
/// much later as on the tape. A '!' unplugs the wire. Several openings go on where the last ended.
/// `wire` and `tape` are borrowed.
/// @errors Fault::refused naming the entry when the other side writes something else; Fault::io.
Task<Result<void>>
play_on_wire(Scheduler& scheduler, NearWire& wire, const Tape& tape, TapePace pace);

} // namespace axiscal
