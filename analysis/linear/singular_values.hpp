#pragma once
// Singular values of a small dense matrix. Pure; equal input gives equal bits on every compiler and
// CPU.

#include "analysis/linear/matrix.hpp"

#include <vector>

namespace axiscal {

/// A = U S V^T, singular values falling; columns of `left` are A v / s (zero where s is zero).
struct SingularValues {
    std::vector<double> values;
    Matrix left, right;
};
/// One-sided Jacobi (Hestenes); small singular values keep their digits, which those of Eigen, good
/// to 1e-16 of the largest, would not.
SingularValues singular_values(const Matrix& matrix);

} // namespace axiscal
