#pragma once
// What one cause alone does to the figures of a circle. Pure.

#include "analysis/circular/seen_points.hpp"

#include <functional>
#include <vector>

namespace axiscal::circular {

struct FormEffect {
    double peak_to_valley_mm = 0; ///< of the term itself, over every point
    /// Range about the least squares circle of the term (first order): of the worse sense, of both.
    double G_mm = 0, G_b_mm = 0;
};

using Term = std::function<double(const Aspect&)>;

FormEffect form_effect(const std::vector<SeenTrace>& traces, const Term& term);

} // namespace axiscal::circular
