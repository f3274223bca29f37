#pragma once
// One row of the design matrix of one direction. Pure.

#include "analysis/separation/error_separation.hpp"

namespace axiscal {

/// Columns by axis x, y, z: [U_0 under rule `paper`], U_1.. ; one free constant at the end.
class DesignRow {
public:
    DesignRow(const SeparationModel& model, ConstantRule rule, std::size_t direction);

    /// Signed columns at a point; the last is the free constant 1. Valid until the next call.
    [[nodiscard]] std::span<const double> at(const PerAxis<double>& point_mm);

    /// Columns of the curves, without the free constant.
    [[nodiscard]] std::size_t curve_columns() const { return row_.size() - 1; }
    [[nodiscard]] std::size_t first_column(std::size_t axis) const { return first_[axis]; }
    [[nodiscard]] std::size_t columns_of(std::size_t axis) const { return count_[axis]; }

private:
    const SeparationModel* model_;
    bool with_constant_;
    PerAxis<double> signs_{};
    PerAxis<std::size_t> first_{}, count_{};
    PerAxis<std::vector<double>> at_reference_;
    std::vector<double> values_, row_;
};

} // namespace axiscal
