#pragma once
// What a part program can ask of the machine. Calls return when the action is done.

#include "cnc/commanded_plane.hpp"

#include <string>

namespace axiscal::simulate {

class MachineActions {
public:
    virtual ~MachineActions() = default;
    /// To an absolute coordinate; feed 0 is the rapid.
    virtual void move(double target_mm, double feed_mm_per_min) = 0;
    /// A way in the plane; a machine of one axis has none.
    virtual void trace(const PlaneMove& /*way*/) {}
    virtual void dwell(double seconds) = 0;
    virtual void set_analog(int output, double value) = 0;
    virtual void set_digital(int output, bool on) = 0;
    /// Waits for an input to be high or low. @returns false when the time runs out first.
    virtual bool wait_input(int input, bool high, double timeout_s) = 0;
    [[nodiscard]] virtual bool input(int input) = 0;
    virtual void message(const std::string& text) = 0;
    virtual void at_line(int line) = 0;       ///< the line that runs now
    [[nodiscard]] virtual bool stopped() = 0; ///< the operator stopped the program
};

} // namespace axiscal::simulate
