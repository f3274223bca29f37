#pragma once
// How a circular test is written on paper. Pure.

#include "acquisition/documents/pdf/wording.hpp"
#include "analysis/circular/circular_certificate.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// One figure of ISO 230-4. `key` is the contract's name.
struct CircularFigureLine {
    std::string key;
    std::string symbol, index; ///< "G(b)" and what stands small beside it, "XY"
    std::string words;
    double value_mm = 0;
};
/// Those that were evaluated, in the contract's order.
std::vector<CircularFigureLine> figure_lines(const CircularCertificate& certificate);
/// "F about the least squares centre"
std::string radial_centre_text(const CircularCertificate& certificate);
/// "Not evaluated: G(b), D: one sense only was measured"
std::vector<std::string> reasons_not_evaluated(const CircularCertificate& certificate);

/// What paper writes for a figure's key: "G XY", "F max YX"; the certificate must outlive it.
std::function<std::string(std::string_view)>
circular_symbols(const CircularCertificate& certificate);

/// Of a micrometre: 2 where the widest zone is below 2 µm, else 1.
int deviation_decimals(const CircularCertificate& certificate);
/// A length in micrometres, with sign where asked.
std::string micrometres(double length_mm, int decimals, bool plus = false);
/// "± 1.2" of U, rounded up; "U not evaluated" where a term is missing.
std::string uncertainty_text(const CircularCertificate& certificate, const std::string& key);

/// At most `digits` digits, true minus: what somebody stated.
std::string compact_number(double value, int digits = 6);
std::string feed_text(double mm_per_s); ///< "1000 mm/min"
std::string sense_name(Sense sense);    ///< "counter-clockwise"
/// "XY" counter-clockwise, "YX" clockwise: from the first to the second.
std::string plane_of(const AxisNames& axes, Sense sense);
/// "0.00°, into quadrant 1": where the reading goes on to.
std::string start_text(const CircularTrace& trace);
/// "359.50°, out of quadrant 4"
std::string end_text(const CircularTrace& trace);
/// "21.3 °C (21.2 to 21.5; bar)"; "not stated"
std::string temperature_text(const CircularTemperature& temperature);
/// Units of the diagnosis' sentences in the signs of paper.
std::string sentence_on_paper(std::string words);

/// Of a case without a date of this form: empty.
std::string iso_date_of(const CircularMeasurement& measured);

} // namespace axiscal
