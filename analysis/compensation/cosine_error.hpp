#pragma once
// What a beam that is not parallel to the axis costs. Pure.

#include "analysis/record/alignment_record.hpp"

namespace axiscal {

/// A beam at the angle gamma to the motion reads D cos(gamma) of a displacement D: short by
/// D (1 - cos gamma), about D gamma^2 / 2, and never long (ISO 230-2 annex A, u_MIS: width dL of a
/// one-sided rectangle).
struct CosineError {
    Length distance;             ///< D over which it was found
    Length error;                ///< by which the reading at D is short, >= 0
    std::optional<Length> bound; ///< it cannot be more; none: unknown
    Angle angle;                 ///< gamma that belongs to `error`
};

/// From the readings at the far end: the best alignment is the one that reads highest, so
///   error = highest - last,    gamma = 2 asin(sqrt(error / (2 D))), exact.
/// Bound: a maximum that the readings passed on both sides is found to within their scatter, hence
/// error + scatter. It holds for the tilts that were steered through their maximum; where none was
/// (FarRest::passed_maximum) the error is only known to be at least `error`, and there is no bound.
/// Readings in vacuum wavelengths stand for lengths: they differ by 3e-4 of the error.
/// Empty without a far rest.
std::optional<CosineError> cosine_error_by_reading(const AlignmentRecord& alignment);

/// From the walk e of the return spot over D; a retroreflector doubles the walk, so
///   tan(gamma) = e / (2 D),    error = D (1 - cos gamma) <= e^2 / (8 D), which is the bound.
/// Empty where no walk was stated, or nothing was travelled.
std::optional<CosineError> cosine_error_by_spot(const AlignmentRecord& alignment);

} // namespace axiscal
