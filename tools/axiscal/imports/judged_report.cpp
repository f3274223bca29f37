#include "tools/axiscal/imports/judged_report.hpp"

#include "config/json_text.hpp"
#include "tools/axiscal/analyze_case.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace axiscal {
namespace {

using Json = nlohmann::json;
using Figures = std::map<std::string, double>;

tl::unexpected<Error> refuse_report(const std::string& key, const std::string& reason) {
    return refuse(Fault::bad_case, "report." + key, reason);
}

/// "E_fwd", "B_avg" as they are called here.
std::string own_name(std::string name) {
    if (name == "B_avg") return "B_mean";
    if (name.ends_with("_fwd")) return name.replace(name.size() - 3, 3, "forward");
    if (name.ends_with("_bwd")) return name.replace(name.size() - 3, 3, "backward");
    return name;
}

/// How many places behind the point the shortest text of a number has.
int places_of(double value) {
    const std::string text = json_text(Json(value));
    const auto point = text.find('.'), exponent = text.find('e');
    const auto end = std::min(exponent, text.size());
    int places = point == std::string::npos ? 0 : static_cast<int>(end - point) - 1;
    if (text.ends_with(".0")) places = 0;
    if (exponent != std::string::npos) places -= std::stoi(text.substr(exponent + 1));
    return std::max(places, 0);
}

/// Half a unit of the last place that any of them has; 0 where none was rounded. One that was not,
/// among others, says nothing of these.
double rounding_of(const Json& numbers) {
    constexpr int unrounded = 12;
    int places = -1;
    const Json flat = numbers.flatten();
    for (const auto& [key, value] : flat.items())
        if (value.is_number() && places_of(value.get<double>()) < unrounded)
            places = std::max(places, places_of(value.get<double>()));
    return places < 0 ? 0 : 0.5 * std::pow(10.0, -places);
}

struct Evaluated {
    Figures figures;
    double low_forward = 0, high_forward = 0, low_backward = 0, high_backward = 0; ///< of the means
};

Result<Evaluated> evaluated(const Json& document) {
    const CaseAnswer answer = analyze_cases(json_text(document));
    const Json result = Json::parse(answer.output, nullptr, false);
    const bool positioning =
        document.is_object() && document.value("analysis", Json{}) == "positioning";
    if (answer.exit_code != 0 || !positioning || !result.is_object() ||
        !result.contains("parameters"))
        return refuse(Fault::bad_case, "case",
                      answer.error_line.empty() ? "is no positioning case" : answer.error_line);
    Evaluated out;
    for (const auto& [key, figure] : result.at("parameters").items())
        out.figures[key] = figure.at("value").get<double>();
    std::vector<double> forward, backward;
    for (const Json& position : result.at("positions")) {
        if (position.value("mean_forward", Json{}).is_number())
            forward.push_back(position.at("mean_forward"));
        if (position.value("mean_backward", Json{}).is_number())
            backward.push_back(position.at("mean_backward"));
    }
    if (!forward.empty())
        std::tie(out.low_forward, out.high_forward) =
            std::pair(std::ranges::min(forward), std::ranges::max(forward));
    if (!backward.empty())
        std::tie(out.low_backward, out.high_backward) =
            std::pair(std::ranges::min(backward), std::ranges::max(backward));
    return out;
}

/// The same with forward and backward exchanged.
std::optional<double> exchanged(const std::string& name, const Figures& figures) {
    const auto value = [&](const std::string& other) -> std::optional<double> {
        const auto found = figures.find(other);
        return found == figures.end() ? std::nullopt : std::optional{found->second};
    };
    if (name == "B_mean") {
        const auto mean = value(name);
        return mean ? std::optional{-*mean} : std::nullopt;
    }
    if (name.ends_with("_forward")) return value(name.substr(0, name.size() - 7) + "backward");
    if (name.ends_with("_backward")) return value(name.substr(0, name.size() - 8) + "forward");
    return std::nullopt;
}

class Judge {
public:
    Judge(Evaluated of_case, std::optional<Evaluated> of_report, double tolerance)
        : case_{std::move(of_case)}
        , report_{std::move(of_report)}
        , tolerance_{tolerance} {}

    [[nodiscard]] std::optional<double> recomputed(const std::string& name) const {
        const auto found = case_.figures.find(name);
        return found == case_.figures.end() ? std::nullopt : std::optional{found->second};
    }
    [[nodiscard]] bool agrees(double published, double value) const {
        return std::fabs(published - value) <= tolerance_;
    }
    [[nodiscard]] std::string code_of(const std::string& name, double published) const {
        if (const std::string code = known(name, published, case_); !code.empty()) return code;
        if (!report_) return "UNEXPLAINED";
        const auto own = report_->figures.find(name);
        if (own != report_->figures.end() && agrees(published, own->second)) return "LAST_SAMPLE";
        const std::string code = known(name, published, *report_);
        return code.empty() ? "UNEXPLAINED" : code;
    }

private:
    [[nodiscard]] std::string
    known(const std::string& name, double published, const Evaluated& of) const {
        const auto is = [&](double value) { return agrees(published, value); };
        const auto figure = [&](const char* key) {
            const auto found = of.figures.find(key);
            return found == of.figures.end() ? std::nan("") : found->second;
        };
        const double low = std::max(of.low_forward, of.low_backward);
        const double high = std::min(of.high_forward, of.high_backward);
        const double lowest = std::min(of.low_forward, of.low_backward);
        const double highest = std::max(of.high_forward, of.high_backward);
        if (name == "E" && (is(figure("E_forward")) || is(figure("E_backward")) ||
                            is(highest - low) || is(high - lowest) || is(high - low)))
            return "E_ONE_SIDE";
        if (name == "R" && (is(figure("R_forward")) || is(figure("R_backward"))))
            return "R_WITHOUT_B";
        const auto other = exchanged(name, of.figures);
        return other && is(*other) ? "DIRECTIONS_SWAPPED" : "";
    }

    Evaluated case_;
    std::optional<Evaluated> report_;
    double tolerance_;
};

std::string sentence_of(const std::string& code) {
    static const std::map<std::string, std::string> sentences{
        {"E_ONE_SIDE", "It is the range of one direction's means, or of the largest of one and the "
                       "smallest of the other; E is that of all means of both directions."},
        {"R_WITHOUT_B",
         "It is the repeatability of one direction; R in both directions holds half of "
         "both spreads and the reversal error."},
        {"DIRECTIONS_SWAPPED", "Forward and backward are exchanged."},
        {"LAST_SAMPLE",
         "The report has other readings than the case, one sample perhaps in place of "
         "the mean of a window; the figure is that of its own readings."},
        {"UNEXPLAINED", "No known mistake gives this figure."}};
    return sentences.at(code);
}

Json finding(const std::string& parameter,
             const Json& published,
             const Json& recomputed,
             const std::string& code) {
    return {{"parameter", parameter},
            {"published", published},
            {"recomputed", recomputed},
            {"code", code},
            {"sentence", sentence_of(code)}};
}

/// A reading that is missing (null) is the same as another that is.
bool are_same(const Json& a, const Json& b, double tolerance) {
    if (!a.is_number() || !b.is_number()) return a.is_null() && b.is_null();
    return std::fabs(a.get<double>() - b.get<double>()) <= tolerance;
}

/// Whether two sets of rows are the same within the rounding of both.
bool same(const Json& a, const Json& b, double tolerance) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i].size() != b[i].size()) return false;
        for (std::size_t j = 0; j < a[i].size(); ++j)
            if (!are_same(a[i][j], b[i][j], tolerance)) return false;
    }
    return true;
}

bool is_row(const Json& row, std::size_t size) {
    return row.is_array() && !row.empty() && row.size() == size &&
           std::ranges::all_of(row,
                               [](const Json& cell) { return cell.is_number() || cell.is_null(); });
}

/// The report's rows in the unit of the case.
Result<Json> rows_in(const Json& report, const char* key, std::size_t targets, double factor) {
    Json rows = report.at(key);
    if (!rows.is_array() || rows.size() != targets)
        return refuse_report(key, "must have " + std::to_string(targets) +
                                      " rows, one a target of the case");
    const std::size_t size = rows.front().is_array() ? rows.front().size() : 0;
    for (Json& row : rows) {
        if (!is_row(row, size))
            return refuse_report(
                key,
                "must be rows of as many numbers each; null stands for a reading that is missing");
        for (Json& cell : row)
            if (factor != 1 && cell.is_number()) cell = cell.get<double>() * factor;
    }
    return rows;
}

enum class Readings : std::uint8_t { none, same, swapped, other };

/// Readings of a report, and how they stand to those of the case.
struct ReportedReadings {
    Readings are = Readings::none;
    Json document; ///< the case with the report's readings
};

Result<ReportedReadings> readings_of(const Json& document, const Json& report, double factor) {
    ReportedReadings out{Readings::none, document};
    double rounding = rounding_of(document.at("forward"));
    for (const char* key : {"forward", "backward"}) {
        if (!report.contains(key)) continue;
        if (!document.contains(key))
            return refuse_report(key, "has readings that the case has not");
        AXISCAL_TRY(out.document[key], rows_in(report, key, document.at("targets").size(), factor));
        rounding = std::max(rounding, rounding_of(report.at(key)) * factor);
        out.are = Readings::same;
    }
    if (out.are == Readings::none) return out;
    const double tolerance = 2.002 * rounding + 1e-12;
    const bool two_sided = document.contains("backward");
    const auto is = [&](const char* first, const char* second) {
        return same(out.document.at("forward"), document.at(first), tolerance) &&
               (!two_sided || same(out.document.at("backward"), document.at(second), tolerance));
    };
    if (is("forward", "backward")) return out;
    out.are = two_sided && is("backward", "forward") ? Readings::swapped : Readings::other;
    return out;
}

/// What a number of the report is in the unit of the case.
Result<double> factor_of(const Json& document, const Json& report) {
    const std::map<std::string, double> lengths{{"m", 1e3}, {"mm", 1}, {"um", 1e-3}};
    const std::map<std::string, double> angles{{"deg", 3600}, {"arcsec", 1}};
    const auto own = document.at("unit").get<std::string>();
    const auto& units = lengths.contains(own) ? lengths : angles;
    const Json stated = report.value("unit", Json(own));
    if (!stated.is_string() || !units.contains(stated.get<std::string>()))
        return refuse_report("unit", lengths.contains(own) ? "must be m, mm or um"
                                                           : "must be deg or arcsec");
    return units.at(stated.get<std::string>()) / units.at(own);
}

Result<void> check_report(const Json& report) {
    if (!report.is_object()) return refuse_report("", "must be an object");
    for (const auto& [key, value] : report.items())
        if (key != "forward" && key != "backward" && key != "parameters" && key != "unit")
            return refuse_report(key, "is unknown; known are forward, backward, parameters, unit");
    if (!report.contains("parameters") || !report.at("parameters").is_object())
        return refuse_report("parameters", "is missing: the published figures by name");
    if (report.at("parameters").empty() && !report.contains("forward"))
        return refuse_report("parameters", "is empty, and no readings stand beside it");
    for (const auto& [key, value] : report.at("parameters").items())
        if (!value.is_number()) return refuse_report("parameters." + key, "must be a number");
    return {};
}

} // namespace

Result<Json> judge_report(const Json& document, const Json& report) {
    AXISCAL_CHECK(check_report(report));
    AXISCAL_TRY(Evaluated of_case, evaluated(document));
    AXISCAL_TRY(const double factor, factor_of(document, report));
    AXISCAL_TRY(const ReportedReadings readings, readings_of(document, report, factor));
    std::optional<Evaluated> of_report;
    if (readings.are == Readings::other) {
        AXISCAL_TRY(of_report, evaluated(readings.document));
    }
    const Json& published = report.at("parameters");
    constexpr double of_readings = 6.5;
    const double rounding = rounding_of(published) * factor * 1.001;
    const double tolerance =
        rounding + of_readings * std::min(rounding_of(document.at("forward")), rounding) + 1e-12;
    const Judge judge{std::move(of_case), std::move(of_report), tolerance};
    Json findings = Json::array();
    if (readings.are == Readings::swapped)
        findings.push_back(finding("readings", {}, {}, "DIRECTIONS_SWAPPED"));
    if (readings.are == Readings::other)
        findings.push_back(finding("readings", {}, {}, "LAST_SAMPLE"));
    for (const auto& [key, value] : published.items()) {
        const std::string name = own_name(key);
        const auto recomputed = judge.recomputed(name);
        if (!recomputed) return refuse_report("parameters." + key, "is no figure of this case");
        const double figure = value.get<double>() * factor;
        if (!judge.agrees(figure, *recomputed))
            findings.push_back(
                finding(key, value, *recomputed / factor, judge.code_of(name, figure)));
    }
    const char* verdict = findings.empty() ? "agrees" : "differs";
    return Json{{"verdict", verdict}, {"findings", std::move(findings)}};
}

} // namespace axiscal
