#include "analysis/separation/chebyshev_basis.hpp"

namespace axiscal {

bool AxisRange::holds(double q) const {
    const double slack = 1e-9 * (to - from);
    return q >= from - slack && q <= to + slack;
}

void second_kind(double t, std::span<double> values) {
    double previous = 0, current = 1;
    for (double& value : values) {
        value = current;
        const double next = 2 * t * current - previous;
        previous = current;
        current = next;
    }
}

std::vector<double> second_from_first_kind(std::span<const double> first) {
    std::vector<double> second(first.size());
    for (std::size_t k = 0; k < first.size(); ++k) {
        const double above = k + 2 < first.size() ? first[k + 2] : 0;
        second[k] = k == 0 ? first[0] - above / 2 : (first[k] - above) / 2;
    }
    return second;
}

double
curve_at(std::span<const double> coefficients, const AxisRange& range, double reference, double q) {
    std::vector<double> here(coefficients.size() + 1), there(coefficients.size() + 1);
    second_kind(range.normalised(q), here);
    second_kind(range.normalised(reference), there);
    double sum = 0;
    for (std::size_t k = 0; k < coefficients.size(); ++k)
        sum += coefficients[k] * (here[k + 1] - there[k + 1]);
    return sum;
}

} // namespace axiscal
