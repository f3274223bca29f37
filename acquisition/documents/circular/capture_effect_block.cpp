#include "acquisition/documents/circular/circular_pages.hpp"
#include "acquisition/documents/circular/circular_units.hpp"
#include "acquisition/documents/circular/circular_wording.hpp"

#include <array>

namespace axiscal {
namespace {

struct DeviationName {
    const char *key, *words;
};
constexpr std::array circular_deviations{
    DeviationName{"G_ccw", "G CCW"}, DeviationName{"G_cw", "G CW"}, DeviationName{"G_b", "G(b)"}};

std::string change_text(const CaptureEffect& effect) {
    std::string words;
    for (const auto& [key, name] : circular_deviations)
        if (const auto found = effect.done_again_mm.find(key); found != effect.done_again_mm.end())
            words += (words.empty() ? "" : ", ") + std::string{name} + " by " +
                     micrometres(found->second, 2, true) + " µm";
    return words;
}

/// Of what G is: of the readings, or of the mean of several circles.
std::string origin_text(const CircularCertificate& certificate) {
    const int repeats = certificate.measured.run.plan.repeats;
    if (repeats <= 1) return "G is that of the readings.";
    return "G is that of the mean circle of " + std::to_string(repeats) +
           " of each sense, their readings averaged angle by angle.";
}

void draw_gains(Sheet& sheet, const CaptureEffect& effect) {
    constexpr double percent_of_one = 100;
    TableRow frequencies{"In the readings, Hz"}, gains{"Amplitude left, %"};
    std::vector<TableColumn> columns{{"Undulations per revolution", "", Align::left}};
    for (const UndulationGain& one : effect.gains) {
        columns.push_back({std::to_string(one.per_revolution), ""});
        frequencies.push_back(compact_number(one.frequency_hz, 3));
        gains.push_back(fixed(one.gain * percent_of_one, 2));
    }
    sheet.table(columns, {frequencies, gains}, 7);
}

} // namespace

void draw_capture_effect(Sheet& sheet, const CircularCertificate& certificate) {
    if (!certificate.capture_effect) return;
    const CaptureEffect& effect = *certificate.capture_effect;
    if (!is_changed(effect.capture)) {
        sheet.text("All readings count, spikes at reversals included. The station file states "
                   "neither averaging nor a filter of the bar's electronics. " +
                       origin_text(certificate),
                   note_style);
        return;
    }
    sheet.heading("What averaging and filter do to G", 80);
    if (!effect.gains.empty()) draw_gains(sheet, effect);
    std::string words = "All readings count, spikes at reversals included, as averaging and filter "
                        "left them. ";
    if (effect.one_percent_per_revolution)
        words += "1 % of the amplitude is lost at " +
                 compact_number(*effect.one_percent_per_revolution, 3) +
                 " undulations per revolution. ";
    if (const std::string changes = change_text(effect); !changes.empty())
        words +=
            "Averaging and filtering the readings once more changes " + changes +
            ": about what the first time took of forms that keep most of their amplitude; what "
            "was lost altogether does not show. ";
    if (!effect.not_known.empty()) words += effect.not_known + " ";
    sheet.text(words + origin_text(certificate), note_style);
}

} // namespace axiscal
