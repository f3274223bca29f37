#pragma once
// Uncertainty of the circular figures: the formula, and a Monte Carlo trial of the whole evaluation
// beside it. Pure.

#include "analysis/circular/circular_parameters.hpp"
#include "analysis/record/circular_setup.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {

struct CircularContribution {
    std::string term;    ///< "device", "calibration", "machine_temperature", ...
    double u_mm = 0;     ///< standard uncertainty
    std::string formula; ///< in words and symbols
    std::string status;  ///< "S": stated by the source; "R": reconstructed
    std::string source;  ///< of "environment": id of the drift test that E_VE is of; empty: stated
};

struct CircularFigureUncertainty {
    std::string key; ///< "G_ccw", "F_max_cw", "D"
    double u_mm = 0;
    double expanded_mm = 0;                 ///< U = 2 u
    std::optional<double> monte_carlo_u_mm; ///< standard deviation of the trials
};

struct CircularBudget {
    double coverage = 2; ///< k
    int runs = 1, trials = 0;
    std::vector<CircularContribution> contributions;
    std::vector<std::string> not_stated;
    std::vector<CircularFigureUncertainty> figures;
    [[nodiscard]] const CircularFigureUncertainty* find(std::string_view key) const;
};

/// Reconstructed from the source's words (it names the terms, its formulas are lost):
///   u(G) = u(G(b)) = sqrt(u_device^2 + (u_repeat^2 + u_EVE^2) / n)
///   u(D) = sqrt(u_cal^2 + (R alpha_M u(theta_M))^2 + (L alpha_B u(theta_B))^2
///               + (R dT_M u(alpha_M))^2 + (L dT_B u(alpha_B))^2 + (u_repeat^2 + u_EVE^2) / n)
///   u(F) = sqrt(u(D)^2 + u_device^2 [+ u_centre^2 about the set-up centre])
///
/// The trials disturb every reading and evaluate anew: the device's error turns linearly over the
/// range read; drift runs straight from one draw of E_VE to another along each trace; temperatures,
/// coefficients and centre are drawn once a trial. Figures of more than 720 readings a trace are
/// tried on every k-th reading. `trials` 0: no trials.
/// @errors those of evaluate_circular; field "uncertainty.…" for what is negative, not finite,
/// lacks its companion, or speaks of temperature where none was given.
Result<CircularBudget> circular_budget(const CircularTest& test,
                                       RadialCentre f_centre,
                                       const std::optional<BarExpansion>& bar,
                                       const CircularUncertaintyStatement& statement,
                                       int trials = 1000,
                                       std::uint64_t seed = 1);

} // namespace axiscal
