#pragma once
// From what the instrument reads beside a certified artefact to the angle of the axis. Pure.
//
// The indexing table stands on the axis and carries the reflectors of the interferometer. The axis
// turns by theta, the table is turned back by k of its steps, and the reflectors face the beam
// again; what is left is the rest:
//     theta = theta_0 + k step + rest - (d_k - d_0),   rest = asin(sign (D - D_0) / (n S))
// with theta_0, D_0 angle and reading at the datum, where the reflectors are square to the beam; D
// the displacement between the two reflectors in vacuum wavelengths, S their distance, n the index
// of air; d_k the certified deviation of the table at position k, counted in the positive direction
// of the axis. Of a polygon theta_0 = 0, where its first face stands before the autocollimator,
// and rest = sign a with the reading a in degrees.
//
// As everywhere, one millimetre of a coordinate stands for one degree.

#include "analysis/quantity/result.hpp"
#include "analysis/record/rotary_setup.hpp"
#include "analysis/record/run_record.hpp"

namespace axiscal {

/// Of the table's position 0: the datum; of the polygon's first face: 0.
Length artefact_zero(const RotarySetup& setup, Length datum);

/// The position at which the rest is smallest: the whole steps nearest to `coordinate`.
int artefact_index(const RotarySetup& setup, Length datum, Length coordinate);

/// 360 degrees hold so many positions.
int positions_of_a_turn(const RotarySetup& setup);

/// Certified deviation d_k of the position, degrees; 0 where none is stated.
double artefact_deviation_deg(const RotarySetup& setup, int index);

/// What a displacement of the reflectors, or a reading of the autocollimator, shows since the
/// datum, in degrees. `since_datum`: D - D_0, or the reading itself.
/// @errors Fault::outside_window when it is more than the instrument's range: then the table does
/// not stand at the position meant, or the optics are not square.
Result<double> rest_deg(const RotarySetup& setup, int sign, Length since_datum, double n_minus_1);

/// Coordinate of the axis with the artefact at position `index`. `n_minus_1` counts for the
/// interferometer alone. @errors those of rest_deg().
Result<Length> rotary_position(const RotarySetup& setup,
                               int sign,
                               const DatumRecord& datum,
                               Length reading,
                               double n_minus_1,
                               int index);

/// The least change of reading that a turn by `way` gives while the rest stays within half a step
/// and the way: S (sin(step/2 + way) - sin(step/2)); of a polygon the way itself.
Length least_reading_of_way(const RotarySetup& setup, Length way);

/// Reading of the interferometer for each degree of a small angle, as a length for a "millimetre"
/// of coordinate: what limits and ways in degrees mean in the samples. 1 for a polygon.
double reading_per_coordinate(const RotarySetup& setup);

} // namespace axiscal
