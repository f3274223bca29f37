#pragma once
// Where the true figures of a run lie: what a session without any error of measurement would have
// found on the same approaches. Pure: a seed gives the same bits on every CPU and compiler.
//
// The annex takes L for every term that grows with length, and each reading's environment by
// itself. Here every term counts by the distance of the targets that make a figure, a beam off the
// axis can only read short, and the environment drifts in the time of the run.

#include "analysis/positioning/positioning_accuracy.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/uncertainty/figure_tally.hpp"
#include "analysis/uncertainty/monte_carlo.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

struct TrueFigure {
    std::string key;
    Interval interval; ///< 95 %, as much probability below as above; in the unit of the run
};

struct TrueFigures {
    int trials = 0; ///< the request, rounded up to whole groups of eight
    std::uint64_t seed = 0;
    std::vector<TrueFigure> figures; ///< those that `result` has, in the contract's order
    [[nodiscard]] const TrueFigure* find(std::string_view key) const;
};

/// Each trial takes drawn common errors off the readings and evaluates what is left. Beside it, the
/// readings with a drawn drift added show by how much such a drift moves each figure (it makes R
/// larger more often than smaller). That is taken off, too. A drift is a random walk from the first
/// reading to the last. E_VE tells how strong it is: a second walk, as long, stands for the drift
/// test, and both are scaled until the second ranges over E_VE (the posterior of a scale for a
/// prior of 1 / scale). So E_VE must come from a test as long as the run; of a shorter one the
/// interval is too narrow. For R, R_forward, R_backward and B, the largest of all targets, a rule
/// takes the place of a derivation: in half of the sessions as above, which gives too little; in
/// the other half the figures of the readings with the drift taken off, which are too large. A
/// range is never below 0. How often the truth lies inside: docs/simulated-truth.md.
/// @param seconds  when each reading was taken, rows of targets, forward, then backward, as
/// `run` has them; any origin. All the same: one after the other, evenly, in that order.
/// @errors Fault::bad_case "trials", "readings" as simulate_sessions(), and below ten; "seconds" of
/// another number than the readings.
Result<TrueFigures> simulate_true_figures(const RunAt20C& run,
                                          const PositioningResult& result,
                                          const SessionErrors& errors,
                                          const std::vector<double>& seconds,
                                          const MonteCarloRequest& request);

} // namespace axiscal
