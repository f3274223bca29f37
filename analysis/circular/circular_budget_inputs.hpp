#pragma once
// What the budget of a circular test is made of, term by term. Pure.

#include "analysis/circular/circular_certificate.hpp"
#include "analysis/uncertainty/budget_input.hpp"

#include <vector>

namespace axiscal {

/// One for each term of the budget, its value the term's standard uncertainty in um; behind them
/// what is not stated. A repeatability that nobody stated is that of the repeats.
std::vector<BudgetInput> budget_inputs_of(const CircularCertificate& certificate);

} // namespace axiscal
