#include "acquisition/documents/positioning/certificate_pages.hpp"
#include "analysis/compensation/cosine_error.hpp"

#include <algorithm>

namespace axiscal {
namespace {

std::string cosine_error_text(const std::optional<CosineError>& found) {
    if (!found) return "not seen";
    std::string words =
        fixed(found->error.in(um), 2) + " µm over " + fixed(found->distance.in(mm), 0) + " mm";
    words += found->bound ? ", at most " + fixed(found->bound->in(um), 2) + " µm"
                          : ", or more: the maximum was not passed";
    return words + " (" + fixed(found->angle.in(radian)*1e3, 2) + " mrad)";
}

std::string strength_text(const std::vector<AlignmentPlace>& places) {
    if (places.empty()) return "not reported by the instrument";
    const auto weakest = std::ranges::min_element(places, {}, &AlignmentPlace::weakest_percent);
    return fixed(places.front().mean_percent, 0) + " % near, " +
           fixed(places.back().mean_percent, 0) + " % far; weakest " +
           fixed(weakest->weakest_percent, 0) + " % at " + fixed(weakest->begin.in(mm), 0) +
           " to " + fixed(weakest->end.in(mm), 0) + " mm";
}

std::string reading_text(const std::optional<FarRest>& far) {
    if (!far) return "the axis did not stand at its far end";
    return fixed((far->highest - far->last).in(um), 2) + " µm below the highest, scatter " +
           fixed(far->scatter.in(um), 2) + " µm";
}

} // namespace

void draw_alignment(Sheet& sheet, const std::optional<AlignmentRecord>& alignment) {
    if (!alignment) return;
    sheet.heading("Alignment of the beam", 100);
    std::vector<StatedField> fields{
        {"Aligned", readable_instant(iso8601_utc(alignment->ended_utc_ns))},
        {"Travel seen", fixed(alignment->reached.in(mm), 1) + " mm of " +
                            fixed(alignment->travel.in(mm), 1) + " mm"},
        {"Strength of the signal", strength_text(alignment->places)},
        {"Reading at the far end, as left", reading_text(alignment->far)},
        {"Cosine error, by the reading", cosine_error_text(cosine_error_by_reading(*alignment))}};
    if (alignment->spot_offset)
        fields.push_back({"Cosine error, by the return spot (" +
                              fixed(alignment->spot_offset->in(mm), 2) + " mm)",
                          cosine_error_text(cosine_error_by_spot(*alignment))});
    sheet.fields(fields, 1);
    sheet.text("A beam at the angle γ reads D cos γ: short by D (1 − cos γ), never long. By the "
               "reading: highest − last at the far end, bounded by the scatter for the tilts that "
               "were steered through their maximum. By the return spot: tan γ = e / 2D.",
               note_style);
}

} // namespace axiscal
