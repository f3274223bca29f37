// `axiscal analyze` on a circle of a million points, against the parsing of the same text.

#include "tests/bench/circle_points.hpp"
#include "tests/bench/row.hpp"
#include "tools/axiscal/analyze_case.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace axiscal::bench {
namespace {

const std::string& million_points() {
    static const std::string text = [] {
        const CirclePoints& points = circle_points(1000000, 360);
        std::string out = R"({"analysis":"circle_fit","points":[)";
        for (std::size_t i = 0; i < points.x.size(); ++i)
            out += (i == 0 ? "" : ",") + nlohmann::json{points.x[i], points.y[i]}.dump();
        return out + "]}";
    }();
    return text;
}

void analyze() {
    if (analyze_cases(million_points()).exit_code != 0) throw std::runtime_error{"refused"};
}

void parse() {
    benchmark::DoNotOptimize(nlohmann::json::parse(million_points()));
}

[[maybe_unused]] const bool added =
    add({"analyze a circle of 1e6 points", analyze, parse, 2, 0, "json::parse"});

} // namespace
} // namespace axiscal::bench
