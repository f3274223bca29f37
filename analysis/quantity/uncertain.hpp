#pragma once
#include <limits>

namespace axiscal {

/// A value with its standard uncertainty (k = 1 always) and degrees of freedom. Pure.
template <class T> struct Uncertain {
    T value{};
    T u{};
    double dof = std::numeric_limits<double>::infinity();
};

} // namespace axiscal
