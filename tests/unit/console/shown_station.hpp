#pragma once
// A station that shows what a test puts there, and takes no order.

#include "acquisition/live/station_interface.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace axiscal::testing {

/// Used on the loop only.
class ShownStation final : public StationInterface {
public:
    [[nodiscard]] StationStatus status() const override {
        ++looks;
        if (shown_change_each_time) shown.utc = std::to_string(looks);
        return shown;
    }
    Task<Result<std::string>> arm(ArmRequest /*request*/) override { co_return no(); }
    Result<void> trigger() override { return no(); }
    Result<void> type_reading(double /*seconds_of_arc*/) override { return no(); }
    Task<Result<RunEnding>> abort(std::string /*reason*/, Orderer /*by*/) override {
        co_return no();
    }
    Task<Result<std::vector<PreflightRecord>>> preflight(ArmRequest /*request*/) override {
        co_return no();
    }
    Task<Result<RetakeAnswer>> retake(RevisionRequest /*request*/) override { co_return no(); }
    Task<Result<int>> exclude(RevisionRequest /*request*/) override { co_return no(); }
    Task<Result<void>> answer_finding(AnswerRequest /*request*/) override { co_return no(); }
    Task<Result<std::string>> drift(DriftRequest /*request*/) override { co_return no(); }
    [[nodiscard]] std::optional<StreamView> stream(std::size_t most) const override {
        ++stream_looks;
        if (!streamed) return std::nullopt;
        streamed->samples += 50;
        StreamView view = *streamed;
        view.stretches.assign(most, MinMax{-1e-6, 1e-6});
        return view;
    }
    [[nodiscard]] PointsView points(std::size_t from) const override {
        PointsView view{run, accepted.size(), {}, excluded, {}, so_far};
        for (std::size_t nth = from; nth < accepted.size(); ++nth)
            view.points.push_back(accepted[nth]);
        if (from == 0) view.targets = targets;
        return view;
    }
    [[nodiscard]] AlignmentView alignment() const override { return {}; }
    Result<void> align(AlignmentOrder /*order*/) override { return no(); }

    void accept(int target, double deviation_um) {
        const int step = static_cast<int>(accepted.size());
        accepted.push_back({{step, static_cast<std::uint16_t>(step + 1),
                             PlannedPoint{step, target, Direction::positive, 0}, um(deviation_um)},
                            mm(100.0 * target)});
    }
    void exclude(std::size_t nth) {
        accepted.at(nth).excluded = true;
        ++excluded;
    }

    mutable StationStatus shown;
    bool shown_change_each_time = false;
    mutable std::optional<StreamView> streamed;
    std::string run;
    std::vector<ShownPoint> accepted;
    std::size_t excluded = 0;
    std::vector<Length> targets;
    std::shared_ptr<const FiguresSoFar> so_far;
    mutable int looks = 0, stream_looks = 0;

private:
    static tl::unexpected<Error> no() { return fail(Fault::refused, "it only shows"); }
};

} // namespace axiscal::testing
