#pragma once
// A probing test as it is drawn: where the control latched, against the distance from which the
// probe came. What is drawn stays inside its box, labels included. Pure.

#include "acquisition/documents/pdf/page.hpp"
#include "acquisition/documents/probing/probing_document.hpp"

#include <array>
#include <string>
#include <vector>

namespace axiscal {

inline constexpr double um_a_mm = 1000;

/// The touches of one series, in the order in which they were made.
struct ProbingTrace {
    const ProbingDelay* figures = nullptr; ///< lives as long as the document
    std::size_t first_touch = 0;           ///< its place in ProbingRecord::touches
    std::vector<double> approach_mm;
    /// Along the direction, so that a later latch is larger; 0 is the smallest point that touches
    /// from growing distances latched in this direction, without such the smallest of the series.
    std::vector<double> offset_um;
};
/// One of each series, in the order of the results.
std::vector<ProbingTrace> probing_traces_of(const ProbingResult& document);

/// One series of touches and the references of its direction. The pointers live as long as the
/// traces.
struct ProbingPanel {
    const ProbingTrace* touches = nullptr;
    std::vector<const ProbingTrace*> references;
};
std::vector<ProbingPanel> probing_panels_of(const std::vector<ProbingTrace>& traces);

/// Lower than this the labels of a panel would touch each other, points.
inline constexpr double least_panel_height = 88;

/// Offset against approach distance: touches as dots, references as rings; the lowest and the
/// highest touch carried to the right, where their distance is E_TD.
void draw_probing_panel(Canvas& canvas, PageBox box, const ProbingPanel& panel);

/// "−X" along an axis, else the three components of the unit vector.
std::string direction_text(const std::array<double, 3>& unit_direction);

} // namespace axiscal
