#include "analysis/checked_numbers.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {

std::string element_of(const std::string& field, std::size_t index) {
    return field + "[" + std::to_string(index) + "]";
}

Result<void> check_case_number(double value, const std::string& field) {
    if (std::isnan(value)) return refuse(Fault::bad_case, field, "is not a number (NaN)");
    if (std::isinf(value)) return refuse(Fault::bad_case, field, "is infinite");
    if (std::fabs(value) > largest_case_number)
        return refuse(Fault::bad_case, field, "is larger than 1e12, beyond any machine");
    return {};
}

Result<void> check_case_numbers(const std::vector<double>& values, const std::string& field) {
    for (std::size_t i = 0; i < values.size(); ++i)
        AXISCAL_CHECK(check_case_number(values[i], element_of(field, i)));
    return {};
}

Result<void> check_positive(double value, const std::string& field) {
    AXISCAL_CHECK(check_case_number(value, field));
    constexpr double smallest = 1e-12;
    if (value >= smallest) return {};
    return refuse(Fault::bad_case, field, value > 0 ? "is smaller than 1e-12" : "must be positive");
}

Result<void> check_rising(const std::vector<double>& values, const std::string& field) {
    AXISCAL_CHECK(check_case_numbers(values, field));
    if (values.empty()) return refuse(Fault::bad_case, field, "is empty");
    const double largest = std::max(std::fabs(values.front()), std::fabs(values.back()));
    const double rounding = std::max(largest * 1e-14, 1e-12);
    for (std::size_t i = 1; i < values.size(); ++i)
        if (!(values[i] - values[i - 1] > rounding))
            return refuse(Fault::bad_case, element_of(field, i),
                          "is not larger than the one before it");
    return {};
}

} // namespace axiscal
