#pragma once
// What the programs of LinuxCNC's dialect wait for.

namespace axiscal {

inline constexpr double arming_limit_s = 600; // a technician needs a while to reach the PC
// The echo comparison runs in the servo thread; the sequence must reach it before it is asked.
inline constexpr double comparison_s = 0.05;

} // namespace axiscal
