#include "tools/axiscal/imports/passes.hpp"

#include <algorithm>
#include <utility>

namespace axiscal {
namespace {

std::vector<double> sorted_targets(std::span<const Captured> captured) {
    std::vector<double> targets;
    for (const Captured& one : captured)
        targets.push_back(one.target);
    std::ranges::sort(targets);
    const auto again = std::ranges::unique(targets);
    targets.erase(again.begin(), again.end());
    return targets;
}

/// Where the targets turn, or one comes again, another pass has begun.
bool goes_on(const LaserPass& pass, std::size_t target) {
    if (pass.readings[target]) return false;
    const std::size_t n = pass.order.size();
    if (n < 2) return true;
    return (pass.order[n - 1] > pass.order[n - 2]) == (target > pass.order[n - 1]);
}

/// Beyond them a column of the map is not that of the targets, or of the runs; memory grows with
/// the product of both.
constexpr std::size_t most_targets_of_passes = 10'000, most_passes = 2000;

tl::unexpected<Error> refuse_many(std::size_t most, const char* what, const char* column) {
    return refuse(Fault::bad_case, "file",
                  "has more than " + std::to_string(most) + " " + what +
                      ": does the map name the right column or signal of the " + column + "?");
}

class Passes {
public:
    explicit Passes(LaserReadings& out)
        : out_{out} {}

    LaserPass& pass_of(const Captured& one, std::size_t target) {
        auto& passes = out_.passes;
        if (one.pass.empty()) {
            const bool same = !passes.empty() && passes.back().says_forward == one.says_forward &&
                              group_ == one.group && goes_on(passes.back(), target);
            group_ = one.group;
            return same ? passes.back() : begin("run " + std::to_string(passes.size() + 1), one);
        }
        const auto known = std::ranges::find(passes, one.pass, &LaserPass::name);
        return known != passes.end() ? *known : begin(one.pass, one);
    }

private:
    LaserPass& begin(std::string name, const Captured& first) {
        LaserPass pass;
        pass.name = std::move(name);
        pass.line = first.line;
        pass.says_forward = first.says_forward;
        pass.readings.resize(out_.targets.size());
        out_.passes.push_back(std::move(pass));
        return out_.passes.back();
    }

    LaserReadings& out_;
    std::string group_; ///< of the last reading
};

} // namespace

Result<void> add_passes(std::span<const Captured> captured, LaserReadings& out) {
    out.targets = sorted_targets(captured);
    if (out.targets.size() > most_targets_of_passes)
        return refuse_many(most_targets_of_passes, "targets", "targets");
    Passes passes{out};
    for (const Captured& one : captured) {
        const auto at = std::ranges::lower_bound(out.targets, one.target);
        const auto target = static_cast<std::size_t>(at - out.targets.begin());
        LaserPass& pass = passes.pass_of(one, target);
        if (out.passes.size() > most_passes) return refuse_many(most_passes, "runs", "runs");
        if (pass.readings[target])
            return refuse(Fault::bad_case, "line " + std::to_string(one.line),
                          pass.name + " has target " + std::to_string(target + 1) + " twice");
        pass.order.push_back(target);
        pass.readings[target] = one.reading;
    }
    return {};
}

} // namespace axiscal
