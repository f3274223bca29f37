#pragma once
// The pages of the report of a probing test, in the order in which they are bound.

#include "acquisition/documents/pdf/sheet.hpp"
#include "acquisition/documents/probing/probing_document.hpp"

#include <vector>

namespace axiscal {

/// What the first page left to the others.
struct ProbingFront {
    std::vector<StatedField> shortened; ///< stated fields that must be printed in full
    bool plotted = false;               ///< the directions had room there
};

/// Page 1: who, what, with what, E_TD and E_0 of each direction, the servo tick, the saw-tooth, the
/// latched points where they have room, the signatures.
ProbingFront draw_probing_front_page(Sheet& sheet, const ProbingResult& document);

/// The latched points unless page 1 has them, then every touch as a table.
void draw_probing_touches(Sheet& sheet, const ProbingResult& document, const ProbingFront& front);

/// The test, what the figures mean, remarks and events.
void draw_probing_conditions(Sheet& sheet,
                             const ProbingResult& document,
                             const ProbingFront& front);

/// Of each series of touches the period of its saw-tooth, or why none was found: one paragraph of
/// those found, one for each reason. Pure.
std::vector<std::string> saw_tooth_words(const std::vector<ProbingDelay>& results);

} // namespace axiscal
