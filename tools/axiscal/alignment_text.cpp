#include "tools/axiscal/align_command.hpp"

#include "analysis/quantity/counted.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

constexpr double full_bar_percent = 100;
constexpr int bar_width = 30;

/// A value that is not there is shown as dashes, never as 0.
std::string number(const Json& value, const char* pattern) {
    if (!value.is_number()) return "- - -";
    char text[64];
    std::snprintf(text, sizeof text, pattern, value.get<double>());
    return text;
}

std::string now_text(const Json& view) {
    if (view.at("running") != true) return "Kept alignment";
    return "Distance   " + number(view.at("distance_mm"), "%.4f") + " mm   " +
           (view.at("at_rest") == true ? "at rest" : "moving ") + "   strength " +
           number(view.at("strength_percent"), "%.0f") + " %";
}

std::string restarts_text(int restarts) {
    if (restarts == 0) return {};
    return "           begun anew " + (restarts == 1 ? "once" : counted(restarts, "time")) +
           ": the counter lost its zero\n";
}

std::string far_text(const Json& far) {
    if (far.is_null())
        return "Far end    drive the axis away from the interferometer, let it stand there\n";
    const double below_um =
        (far.at("highest_mm").get<double>() - far.at("last_mm").get<double>()) * 1e3;
    std::string text = "Far end    highest reading at " + number(far.at("distance_mm"), "%.4f") +
                       " mm, the last one " + number(Json(below_um), "%.2f") +
                       " µm below it, scatter " + number(far.at("scatter_um"), "%.2f") + " µm\n";
    if (far.at("passed_maximum") != true)
        text += "           steer the beam until the reading has fallen on both sides of its "
                "highest; so with each tilt\n";
    return text;
}

std::string cosine_text(const Json& found, const char* by) {
    if (found.is_null()) return {};
    return "Cosine     " + number(found.at("error_um"), "%.2f") + " µm over " +
           number(found.at("distance_mm"), "%.0f") + " mm, " +
           (found.at("bound_um").is_null()
                ? std::string{"or more"}
                : "at most " + number(found.at("bound_um"), "%.2f") + " µm") +
           " (" + number(found.at("angle_mrad"), "%.2f") + " mrad), " + by + "\n";
}

std::string bar(double share_percent) {
    const double share = std::clamp(share_percent / full_bar_percent, 0.0, 1.0);
    std::string text;
    for (int i = 0; i < static_cast<int>(std::lround(share * bar_width)); ++i)
        text += "█";
    return text;
}

std::string places_text(const Json& places) {
    if (places.empty()) return "Strength   is not reported by this laser\n";
    std::string text = "    from      to mm   mean  weakest   last %\n";
    for (const Json& place : places) {
        char line[128];
        std::snprintf(line, sizeof line, "%8.0f%8.0f    %5.0f    %5.0f  %5.0f  ",
                      place.at("from_mm").get<double>(), place.at("to_mm").get<double>(),
                      place.at("mean_percent").get<double>(),
                      place.at("weakest_percent").get<double>(),
                      place.at("last_percent").get<double>());
        text += line + bar(place.at("last_percent").get<double>()) + "\n";
    }
    return text;
}

} // namespace

std::string alignment_text(const Json& view) {
    const Json& record = view.at("record");
    if (record.is_null()) return "No alignment was kept since the station was started.\n";
    std::string text = now_text(view) + "\n";
    text += "Beam       " + record.at("instrument").get<std::string>() + " " +
            record.at("serial").get<std::string>() + ", seen " +
            number(record.at("reached_mm"), "%.1f") + " mm of " +
            number(record.at("travel_mm"), "%.1f") + " mm since " +
            record.at("began").get<std::string>() + "\n";
    text += restarts_text(record.at("restarts").get<int>());
    text += far_text(record.at("far"));
    text += cosine_text(record.at("cosine"), "by the reading");
    text += cosine_text(record.at("cosine_by_spot"), "by the return spot");
    return text + places_text(record.at("places"));
}

} // namespace axiscal
