#include "analysis/straightness/mirror_reversal.hpp"

#include <cstddef>

namespace axiscal {

Result<PartedOptics> part_optics(const MeasuredLine& normal, const MeasuredLine& reversed) {
    AXISCAL_TRY(const Straightness first, straightness_of(normal));
    AXISCAL_TRY(const Straightness second, straightness_of(reversed));
    if (normal.positions != reversed.positions)
        return refuse(Fault::bad_case, "targets",
                      "of both positions of the mirror are not the same: take both runs by one "
                      "plan");
    PartedOptics out{{normal.positions, {}}, {normal.positions, {}}};
    for (std::size_t i = 0; i < normal.positions.size(); ++i) {
        const double a = first.least_squares.residuals[i];
        const double b = second.least_squares.residuals[i];
        out.axis.deviations.push_back((a + b) / 2);
        out.mirror.deviations.push_back((a - b) / 2);
    }
    return out;
}

} // namespace axiscal
