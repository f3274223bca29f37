#include "acquisition/documents/squareness/squareness_paper.hpp"

#include "acquisition/documents/squareness/squareness_csv.hpp"
#include "acquisition/documents/squareness/squareness_json.hpp"

#include <utility>

namespace axiscal {

Result<SquarenessResult> PaperOf<SquarenessResult>::evaluated(const std::string& path,
                                                              RunFileContents contents) {
    return squareness_result_of(path, std::move(contents));
}

nlohmann::ordered_json PaperOf<SquarenessResult>::json(const SquarenessResult& one) {
    return squareness_to_json(one);
}

std::string PaperOf<SquarenessResult>::csv(const SquarenessResult& one) {
    return squareness_csv(one);
}

nlohmann::ordered_json PaperOf<SquarenessResult>::figures(const SquarenessResult& one) {
    return squareness_figures_json(one);
}

/// An arc tangent of the C library stands in them.
FigureAgreement PaperOf<SquarenessResult>::agreement(const SquarenessResult& /*one*/) {
    return rounding_of_the_library;
}

std::string PaperOf<SquarenessResult>::finished_utc(const SquarenessResult& one) {
    return iso8601_utc(one.run.closed.utc_ns);
}

} // namespace axiscal
