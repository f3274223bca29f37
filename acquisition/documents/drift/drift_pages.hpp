#pragma once
// The pages of the report of a drift test, in the order in which they are bound.

#include "acquisition/documents/drift/drift_document.hpp"
#include "acquisition/documents/pdf/sheet.hpp"

#include <vector>

namespace axiscal {

/// Page 1: who, what, with what, E_VE and ETVE, the axis against time, the signatures.
/// @returns stated fields that did not fit and must be printed in full by the last pages.
std::vector<StatedField> draw_drift_front_page(Sheet& sheet, const DriftResult& document);

/// The axis above, then every other channel, all against one axis of time; range, slope and what
/// else is known of each.
void draw_drift_channels(Sheet& sheet, const RunDrift& drift);

/// The test, compensation, alignment, remarks and events.
/// @param shortened  what the front page could not print in full.
void draw_drift_conditions(Sheet& sheet,
                           const DriftResult& document,
                           const std::vector<StatedField>& shortened);

/// What rested: "axis X", "ballbar, plane XY". Pure.
std::string drift_subject_text(const DriftResult& document);

/// Where the axis rests: "900.000 mm", of a rotary axis "-2.000°". Pure.
std::string drift_place_text(const DriftResult& document);

/// "30 min", "90 s", "12 h": the largest unit in which it is whole, else seconds with a point.
/// Pure.
std::string duration_text(Duration duration);

} // namespace axiscal
