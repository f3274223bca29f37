#include "analysis/circular/contribution.hpp"

#include "analysis/circular/row_fit.hpp"

#include <algorithm>
#include <array>

namespace axiscal::circular {
namespace {

struct Range {
    bool empty = true;
    double low = 0, high = 0;
    void include(double value) {
        low = empty ? value : std::min(low, value);
        high = empty ? value : std::max(high, value);
        empty = false;
    }
    [[nodiscard]] double width() const { return high - low; }
};

using TraceList = std::vector<const SeenTrace*>;

double range_without_circle(const TraceList& traces, const Term& term) {
    RowFit fit{3};
    for (const SeenTrace* trace : traces)
        for (const SeenPoint& point : trace->points)
            fit.add(std::array{1.0, point.aspect.cosine, point.aspect.sine}, term(point.aspect));
    const std::vector<double> circle = fit.solve().value;
    Range range;
    for (const SeenTrace* trace : traces)
        for (const SeenPoint& point : trace->points)
            range.include(term(point.aspect) - circle[0] - circle[1] * point.aspect.cosine -
                          circle[2] * point.aspect.sine);
    return range.width();
}

} // namespace

FormEffect form_effect(const std::vector<SeenTrace>& traces, const Term& term) {
    Range range;
    TraceList both;
    FormEffect effect;
    for (const SeenTrace& trace : traces) {
        both.push_back(&trace);
        for (const SeenPoint& point : trace.points)
            range.include(term(point.aspect));
        effect.G_mm = std::max(effect.G_mm, range_without_circle({&trace}, term));
    }
    effect.peak_to_valley_mm = range.width();
    effect.G_b_mm = both.size() > 1 ? range_without_circle(both, term) : effect.G_mm;
    return effect;
}

} // namespace axiscal::circular
