#include "tools/axiscal/cases/plausibility.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

namespace axiscal {
namespace {

using nlohmann::json;

/// A machine of less travel is rarer than millimetres that were taken for micrometres.
constexpr double least_travel_um = 1e5, least_travel_arcsec = 3600;
constexpr double most_turns = 10;
constexpr double largest_radial_mm = 1; ///< a ball bar's whole stroke is of this size
constexpr double largest_device_um = 100;

double span_of(const std::vector<double>& targets) {
    const auto [low, high] = std::ranges::minmax(targets);
    return high - low;
}

/// Empty for a single target.
std::optional<double> smallest_interval(std::vector<double> targets) {
    std::ranges::sort(targets);
    std::optional<double> smallest;
    for (std::size_t i = 1; i < targets.size(); ++i)
        smallest = std::min(smallest.value_or(HUGE_VAL), targets[i] - targets[i - 1]);
    return smallest;
}

struct Farthest {
    std::string place;
    double deviation = 0;
};

void look_at(const Rows& rows, const char* name, Farthest& farthest) {
    for (std::size_t target = 0; target < rows.size(); ++target)
        for (std::size_t approach = 0; approach < rows[target].size(); ++approach)
            if (std::fabs(rows[target][approach]) > std::fabs(farthest.deviation))
                farthest = {indexed(indexed(name, target), approach), rows[target][approach]};
}

void add_interval_remark(const PositioningInput& input, std::vector<std::string>& remarks) {
    Farthest farthest;
    look_at(input.run.forward(), "forward", farthest);
    look_at(input.run.backward(), "backward", farthest);
    const auto interval = smallest_interval(input.run.targets());
    if (!interval || std::fabs(farthest.deviation) * base_units_in(input.axis.unit) <=
                         *interval * base_units_in(input.axis.target_unit) / 2)
        return;
    remarks.push_back(farthest.place + " deviates by " + six_digits(farthest.deviation) + " " +
                      input.axis.unit + ", more than half the interval between targets (" +
                      six_digits(*interval) + " " + input.axis.target_unit +
                      "): are the rows positions (\"readings\": \"positions\"), are both units " +
                      "right, or did an encoder pass its zero?");
}

/// A number under `key` of `uncertainty`.
std::optional<double> stated(const json& object, const char* key) {
    const auto budget = object.find("uncertainty");
    if (budget == object.end() || !budget->is_object()) return std::nullopt;
    const auto number = budget->find(key);
    if (number == budget->end() || !number->is_number()) return std::nullopt;
    return number->get<double>();
}

void add_approaches_remark(const json& object,
                           const PositioningInput& input,
                           std::vector<std::string>& remarks) {
    const auto n = stated(object, "n");
    const double rows = fewest_readings(input.run);
    if (n && *n != rows)
        remarks.push_back("uncertainty.n states " + six_digits(*n) + " approaches, the rows hold " +
                          six_digits(rows) + ": the uncertainties are those of the rows");
}

void add_length_remark(const json& object,
                       const PositioningInput& input,
                       std::vector<std::string>& remarks) {
    const auto length_m = stated(object, "length_m");
    const double travel_m =
        span_of(input.run.targets()) * base_units_in(input.axis.target_unit) / 1000;
    if (!length_m || !(travel_m > 0)) return;
    if (*length_m > 10 * travel_m || *length_m < travel_m / 10)
        remarks.push_back("uncertainty.length_m states " + six_digits(*length_m) +
                          " m, the targets span " + six_digits(travel_m) +
                          " m: are both in the unit that they are said to be in?");
}

void add_device_remark(const json& object, const char* key, std::vector<std::string>& remarks) {
    const auto width_um = stated(object, key);
    if (width_um && *width_um > largest_device_um)
        remarks.push_back(std::string{"uncertainty."} + key + " states " + six_digits(*width_um) +
                          " um: no laser or scale is so bad; is it in nm?");
}

void add_trace_remarks(const CircularTrace& trace, std::vector<std::string>& remarks) {
    const std::string which = "the trace " + std::string{name_of(trace.sense)};
    const double turns = span_of(trace.angle_rad) / (2 * std::numbers::pi);
    if (turns > most_turns)
        remarks.push_back(which + " turns " + six_digits(std::round(turns)) +
                          " times: are its angles degrees (angle_deg)?");
    const auto [low, high] = std::ranges::minmax(trace.radial_deviation_mm);
    const double largest = std::max(std::fabs(low), std::fabs(high));
    if (largest > largest_radial_mm)
        remarks.push_back(which + " deviates by up to " + six_digits(largest) +
                          " mm: are its readings micrometres?");
}

} // namespace

std::string six_digits(double value) {
    std::array<char, 32> text{};
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 6);
    return {text.data(), end.ptr};
}

std::vector<std::string>
unit_remarks(const std::vector<double>& targets, const std::string& unit, const std::string& key) {
    const bool angle = unit == "arcsec";
    if (targets.empty() || (unit != "um" && !angle)) return {};
    const double span = span_of(targets);
    if (!(span > 0) || span >= (angle ? least_travel_arcsec : least_travel_um)) return {};
    const std::string travel =
        angle ? six_digits(span / 3600) + " deg" : six_digits(span / 1000) + " mm";
    return {"the targets are taken in " + unit + ", as the deviations, so that they span " +
            travel + ": if they are " + (angle ? "degrees, state \"" : "millimetres, state \"") +
            key + (angle ? "\": \"deg\"" : "\": \"mm\"")};
}

std::vector<std::string> positioning_remarks(const json& object, const PositioningInput& input) {
    std::vector<std::string> remarks;
    if (!object.contains("target_unit"))
        remarks = unit_remarks(input.run.targets(), input.axis.unit, "target_unit");
    add_interval_remark(input, remarks);
    add_approaches_remark(object, input, remarks);
    add_length_remark(object, input, remarks);
    for (const char* key : {"device_U_um", "device_width_um"})
        add_device_remark(object, key, remarks);
    return remarks;
}

std::vector<std::string> circular_remarks(const CircularTest& test) {
    std::vector<std::string> remarks;
    for (const CircularTrace& trace : test.traces)
        add_trace_remarks(trace, remarks);
    return remarks;
}

void add_remarks(const std::vector<std::string>& remarks, nlohmann::ordered_json& document) {
    for (const std::string& remark : remarks)
        document["remarks"].push_back(remark);
}

} // namespace axiscal
