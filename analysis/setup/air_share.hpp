#pragma once
// How much of the air's swings a material sensor shows: one that touches the machine shows little
// of them, one that hangs in the air nearly all. Pure.

#include "analysis/drift/drift.hpp"

#include <cstddef>
#include <optional>

namespace axiscal {

/// Sums over one window or several of them; what changes slower than a window is left out, for a
/// machine follows that, too.
class AirShare {
public:
    /// Both about their own straight line, at the material's times; the air is taken linearly
    /// between its readings. A window with fewer than ten readings of either tells nothing.
    void add_window(const DriftSeries& material_C, const DriftSeries& air_C);
    /// Empty where the air swings by less than 0.03 K (root mean square), or the two do not move
    /// together: correlation below `least_correlation`.
    [[nodiscard]] std::optional<double> share(double least_correlation) const;

private:
    double air_air_ = 0, air_material_ = 0, material_material_ = 0;
    std::size_t n_ = 0;
};

/// Too few readings to tell who follows whom.
bool tells_no_share(const DriftSeries& series);

} // namespace axiscal
