#pragma once
// The pages of a positioning certificate, in the order in which they are bound.

#include "acquisition/documents/pdf/front_parts.hpp"
#include "acquisition/documents/pdf/sheet.hpp"
#include "acquisition/documents/pdf/wording.hpp"

namespace axiscal {

/// Page 1: who, what, with what, the parameters, the deviation plot, the signatures.
/// @returns stated fields that did not fit and must be printed in full by the condition pages.
std::vector<StatedField> draw_front_page(Sheet& sheet, const Certificate& certificate);

/// Per target: means, s, B_i, R_i; then every single deviation. As many pages as it takes.
void draw_target_pages(Sheet& sheet, const Certificate& certificate);

/// Environment, compensation to 20 °C, uncertainty budget, cycle, sensor places, remarks and
/// events.
/// @param shortened  what the front page could not print in full.
void draw_condition_pages(Sheet& sheet,
                          const Certificate& certificate,
                          const std::vector<StatedField>& shortened);

/// Figures by the other standards that were chosen, beside the certificate's own; nothing without.
void draw_other_standards(Sheet& sheet, const Certificate& certificate);

/// The budget: what is stated, each term, each parameter, U against its target.
void draw_uncertainty(Sheet& sheet, const Certificate& certificate);

/// How a linear scale measured the axis; in the place of what is said of laser and air.
void draw_scale(Sheet& sheet, const Certificate& certificate);
/// How the angle of a rotary axis was measured; in the place of the compensation.
void draw_angle(Sheet& sheet, const Certificate& certificate);

/// How the beam was aligned, and what its angle costs; nothing where nobody recorded it.
void draw_alignment(Sheet& sheet, const std::optional<AlignmentRecord>& alignment);

} // namespace axiscal
