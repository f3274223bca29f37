#include "analysis/record/circular_setup.hpp"

namespace axiscal {

std::string_view name_of(Sense sense) {
    return sense == Sense::ccw ? "ccw" : "cw";
}

std::string_view name_of(CircularPlane plane) {
    if (plane == CircularPlane::xy) return "XY";
    return plane == CircularPlane::yz ? "YZ" : "ZX";
}

std::array<std::string, 2> axes_of(CircularPlane plane) {
    const std::string_view name = name_of(plane);
    return {std::string{name.substr(0, 1)}, std::string{name.substr(1, 1)}};
}

std::string_view name_of(StartMethod method) {
    return method == StartMethod::feed_step ? "feed_step" : "trigger";
}

std::vector<PlannedCircle> planned_circles(const CircularPlan& plan) {
    std::vector<PlannedCircle> circles;
    const auto add = [&](int repeats, bool warm_up) {
        for (int repeat = 1; repeat <= repeats; ++repeat)
            for (const Sense sense : plan.senses)
                circles.push_back({static_cast<int>(circles.size()) + 1, sense, repeat, warm_up});
    };
    circles.reserve(plan.senses.size() * static_cast<std::size_t>(plan.warm_up + plan.repeats));
    add(plan.warm_up, true);
    add(plan.repeats, false);
    return circles;
}

double entry_deg(const CircularPlan& plan, Sense sense) {
    return sense == Sense::ccw ? plan.start_deg - plan.overshoot_deg
                               : plan.start_deg + plan.arc_deg + plan.overshoot_deg;
}

double exit_deg(const CircularPlan& plan, Sense sense) {
    return entry_deg(plan, sense == Sense::ccw ? Sense::cw : Sense::ccw);
}

} // namespace axiscal
