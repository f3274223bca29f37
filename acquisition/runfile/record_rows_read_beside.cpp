// Rows of what may stand beside every test: how the beam was aligned, where E_VE comes from.
#include "acquisition/runfile/record_readers.hpp"

namespace axiscal::record_readers {

void read_alignment(RecordedRun& run, RowReader& in) {
    AlignmentRecord alignment;
    alignment.began_utc_ns = in.integer();
    alignment.ended_utc_ns = in.integer();
    alignment.instrument = in.text();
    alignment.serial = in.text();
    alignment.travel = in.length();
    alignment.reached = in.length();
    alignment.readings = in.number<int>();
    alignment.lost = in.number<int>();
    alignment.restarts = in.number<int>();
    std::optional<Length> distance, highest, last, scatter;
    for (auto* length : {&distance, &highest, &last, &scatter})
        read_optional(*length, in);
    const auto blocks = in.optional_integer(), passed = in.optional_integer();
    if (distance && highest && last && scatter && blocks && passed)
        alignment.far =
            FarRest{*distance, *highest, *last, *scatter, static_cast<int>(*blocks), *passed != 0};
    else if (distance || highest || last || scatter || blocks || passed)
        in.reject("states a part of the far rest");
    read_optional(alignment.spot_offset, in);
    if (run.attachments.alignment) return in.reject("stands there twice");
    run.attachments.alignment = std::move(alignment);
}

void read_alignment_place(RecordedRun& run, RowReader& in) {
    AlignmentPlace place;
    place.begin = in.length();
    place.end = in.length();
    place.readings = in.number<int>();
    place.weakest_percent = in.real();
    place.mean_percent = in.real();
    place.last_percent = in.real();
    auto& alignment = run.attachments.alignment;
    if (!alignment) alignment.emplace(); // the writer checks each row by itself
    alignment->places.push_back(place);
}

void read_eve_source(RecordedRun& run, RowReader& in) {
    run.attachments.eve_source = in.text();
}

} // namespace axiscal::record_readers
