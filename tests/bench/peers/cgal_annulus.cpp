// The annulus of least area about points from standard input (a count, then x y), by CGAL: the
// target of a minimum zone but for the factor R + r, which hardly changes near a circle. Prints
// milliseconds, best of the passes, and the width.

#include <CGAL/MP_Float.h>
#include <CGAL/Min_annulus_d.h>
#include <CGAL/Min_sphere_annulus_d_traits_2.h>
#include <CGAL/Simple_cartesian.h>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

using Kernel = CGAL::Simple_cartesian<double>;
using Traits = CGAL::Min_sphere_annulus_d_traits_2<Kernel, CGAL::MP_Float, double>;

int main(int argc, char** argv) {
    long count = 0;
    if (std::scanf("%ld", &count) != 1) return 1;
    std::vector<Kernel::Point_2> points;
    double x = 0, y = 0;
    while (static_cast<long>(points.size()) < count && std::scanf("%lf %lf", &x, &y) == 2)
        points.emplace_back(x, y);
    double best = 1e300, width = 0;
    for (int pass = 0; pass < (argc > 1 ? std::atoi(argv[1]) : 1); ++pass) {
        const auto begin = std::chrono::steady_clock::now();
        const CGAL::Min_annulus_d<Traits> annulus{points.begin(), points.end()};
        const std::chrono::duration<double, std::milli> took =
            std::chrono::steady_clock::now() - begin;
        best = std::min(best, took.count());
        const double square = CGAL::to_double(annulus.squared_radii_denominator());
        width = std::sqrt(CGAL::to_double(annulus.squared_outer_radius_numerator()) / square) -
                std::sqrt(CGAL::to_double(annulus.squared_inner_radius_numerator()) / square);
    }
    std::printf("%.6f %.12f\n", best, width);
}
