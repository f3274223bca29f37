#include "analysis/separation/design_row.hpp"

#include <algorithm>

namespace axiscal {

DesignRow::DesignRow(const SeparationModel& model, ConstantRule rule, std::size_t direction)
    : model_{&model}
    , with_constant_{rule == ConstantRule::paper}
    , signs_{model.signs[direction]} {
    std::size_t columns = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t order = model.orders[direction][axis];
        at_reference_[axis].resize(order + 1);
        second_kind(model.ranges_mm[axis].normalised(model.reference_mm[axis]),
                    at_reference_[axis]);
        first_[axis] = columns;
        count_[axis] = order + (with_constant_ ? 1 : 0);
        columns += count_[axis];
        values_.resize(std::max(values_.size(), order + 1));
    }
    row_.assign(columns + 1, 1);
}

std::span<const double> DesignRow::at(const PerAxis<double>& point_mm) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t terms = at_reference_[axis].size();
        second_kind(model_->ranges_mm[axis].normalised(point_mm[axis]),
                    std::span{values_}.first(terms));
        double* out = row_.data() + first_[axis];
        if (with_constant_)
            for (std::size_t k = 0; k < terms; ++k)
                *out++ = signs_[axis] * values_[k];
        else
            for (std::size_t k = 1; k < terms; ++k)
                *out++ = signs_[axis] * (values_[k] - at_reference_[axis][k]);
    }
    return row_;
}

} // namespace axiscal
