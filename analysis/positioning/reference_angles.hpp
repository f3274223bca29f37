#pragma once
// Angles read against a certified artefact: a polygon before an autocollimator, an indexing table
// under an angular interferometer. Pure.
//
// With phi the direction of the face (of the table's upper part) and x the deviation of the axis,
// all counted in the positive direction of the axis, the instrument sees
//     reading = x + deviation of the face + constant,   hence   x = reading - deviation of the
//     face.
// The constant (set-up, datum of the certificate) cancels in every figure but NMTBA's offset.

#include "analysis/positioning/positioning_accuracy.hpp"

#include <string>
#include <vector>

namespace axiscal {

struct ReferenceAngles {
    std::vector<double> deviation_arcsec; ///< certified, by face; the first is face 1
    std::vector<int> face_of_target; ///< number of the face (index) seen at each target, from 1
    /// A positive certified deviation stands turned in the axis's positive direction.
    bool certificate_with_axis = true;
    /// A positive reading is a turn in the axis's positive direction.
    bool reading_with_axis = true;
    std::string deviation_field, face_field; ///< names for refusals
};

/// Turns the readings in `table` into deviations of the axis. `degrees_per_unit` and
/// `degrees_per_target_unit` tell the units of the table.
/// @errors Fault::bad_case: fewer than two faces, a face that is not there, not one a target, or
/// faces that do not stand at the targets: faces are 360/f degrees apart, numbered either way
/// round, and a target may lie up to one degree beside its face.
Result<void> take_out_reference(const ReferenceAngles& reference,
                                double degrees_per_unit,
                                double degrees_per_target_unit,
                                DeviationTable& table);

} // namespace axiscal
