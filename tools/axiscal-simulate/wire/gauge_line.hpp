#pragma once
// Answers of length gauges and read-outs, from their manuals' tables. Pure.
//   HEIDENHAIN ND 28x: sign, ten places with the point and blanks in front, blank, unit, sorting,
//   series, CR LF. Mitutoyo (QM-Height, 6.2.2): "01A", sign, eight places, CR. Sylvac opto RS: each
//   command comes back as it was sent, then sign, three places, point, three places, CR.

#include <string>
#include <string_view>

namespace axiscal::simulate {

std::string heidenhain_record(double value_mm);
std::string mitutoyo_record(double value_mm);
std::string sylvac_record(double value_mm);

/// What the gauge of this kind ("nd-28x", "mitutoyo", "sylvac") sends back; takes from `typed`
/// what it has understood. Empty: nothing (yet).
std::string gauge_answer(std::string_view kind, std::string& typed, double value_mm);

} // namespace axiscal::simulate
