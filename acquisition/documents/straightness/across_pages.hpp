#pragma once
// What the pages of a straightness and of a squareness certificate have alike.

#include "acquisition/documents/pdf/sheet.hpp"
#include "acquisition/documents/straightness/across_run_file.hpp"

#include <string>
#include <vector>

namespace axiscal {

/// What stands on every page. @param test  "axis X, straightness"
/// @param not_stated  terms that the budget lacks
PageFrame across_frame_of(const AcrossRun& one,
                          const std::string& test,
                          const std::vector<std::string>& not_stated);

/// The fields that every first page begins with; of a partial result without number and due date.
std::vector<StatedField> across_identity_fields(const AcrossRun& one);

/// What the budget lacks, how many readings a partial result lacks; nothing where all is there.
void draw_what_is_missing(Sheet& sheet,
                          const AcrossRun& one,
                          const std::vector<std::string>& not_stated);

/// At the end of the first page.
void draw_across_signatures(Sheet& sheet, const AcrossRun& one);

/// Forward, then backward, a row a target.
void draw_every_deviation(Sheet& sheet, const AcrossRun& one, int decimals);

/// "the uncertainty of the factor of the optics; a limit of the mirror's form"; empty: none.
std::string missing_on_paper(const std::vector<std::string>& not_stated);

/// Channels, optics, cycle, alignment, remarks, events.
/// @param square  fields of the optical square; empty: there was none
/// @param shortened  what the front page could not print in full
void draw_across_conditions(Sheet& sheet,
                            const AcrossRun& one,
                            const std::vector<StatedField>& square,
                            const std::vector<StatedField>& shortened);

/// "1.5 µm" | "1.5″" | "not stated".
std::string um_stated(const std::optional<Length>& length);
std::string arcsec_stated(const std::optional<Angle>& angle);

} // namespace axiscal
