// Chebyshev fit of a million points, degree 12. The limit is one pass over them: x . y.

#include "analysis/separation/chebyshev_fit.hpp"
#include "tests/bench/row.hpp"

#include <Eigen/QR>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace axiscal::bench {
namespace {

constexpr std::size_t count = 1'000'000, degree = 12;

struct Points {
    std::vector<double> x, y;
};

/// Spread over the range, one curve and noise; the same by shape as in peers/numpy_chebyshev.py.
const Points& points() {
    static const Points made = [] {
        std::mt19937_64 random{1};
        std::uniform_real_distribution<double> anywhere{0, 80};
        std::normal_distribution<double> noise{0, 0.3};
        Points all;
        for (std::size_t i = 0; i < count; ++i) {
            all.x.push_back(anywhere(random));
            all.y.push_back(4 * std::sin(all.x.back() / 9) + noise(random));
        }
        return all;
    }();
    return made;
}

/// Sixteen sums abreast: the pass is bound by reading, not by the latency of an addition.
void dot_pass() {
    typedef double Pair __attribute__((vector_size(16), aligned(8), may_alias));
    struct Sum {
        Pair value{};
    };
    const Points& all = points();
    std::array<Sum, 8> sums{};
    for (std::size_t i = 0; i < count; i += 2 * sums.size()) {
        const auto* x = reinterpret_cast<const Pair*>(&all.x[i]);
        const auto* y = reinterpret_cast<const Pair*>(&all.y[i]);
        for (std::size_t pair = 0; pair < sums.size(); ++pair)
            sums[pair].value += x[pair] * y[pair];
    }
    benchmark::DoNotOptimize(sums);
}

Work fit(ChebyshevMethod method) {
    return [method] {
        const Points& all = points();
        benchmark::DoNotOptimize(fit_chebyshev(all.x, all.y, degree, {0, 80}, method));
    };
}

/// What Eigen offers for it: the matrix of all columns, 104 MB, by Householder's reflections.
void eigen_qr() {
    const Points& all = points();
    const auto rows = static_cast<Eigen::Index>(count);
    const Eigen::Map<const Eigen::VectorXd> x{all.x.data(), rows}, y{all.y.data(), rows};
    const Eigen::ArrayXd t = (x.array() - 40) / 40;
    const auto last = static_cast<Eigen::Index>(degree);
    Eigen::MatrixXd columns{rows, last + 1};
    columns.col(0).setOnes();
    columns.col(1) = t;
    for (Eigen::Index k = 2; k <= last; ++k)
        columns.col(k) = 2 * t * columns.col(k - 1).array() - columns.col(k - 2).array();
    const Eigen::VectorXd solution = columns.householderQr().solve(y);
    benchmark::DoNotOptimize(solution);
}

[[maybe_unused]] const bool added =
    add({"Chebyshev fit, 1e6 points, degree 12", fit(ChebyshevMethod::automatic), dot_pass, 20, 0,
         "dot pass", 30, "Eigen HouseholderQR", eigen_qr}) &&
    add({"the same by blocked QR (fall-back)", fit(ChebyshevMethod::qr), dot_pass, 0, 0,
         "dot pass"});

} // namespace
} // namespace axiscal::bench
