#pragma once
// Temperature is affine: two of them have a difference, but no sum.

#include "analysis/quantity/quantity.hpp"

namespace axiscal {

/// A temperature on the Celsius scale. Pure.
class Temperature {
public:
    constexpr Temperature() = default;
    static constexpr Temperature celsius(double degrees) { return Temperature{degrees}; }
    static constexpr Temperature kelvin(double kelvins) { return Temperature{kelvins - 273.15}; }
    [[nodiscard]] constexpr double in_celsius() const { return celsius_; }
    [[nodiscard]] constexpr double in_kelvin() const { return celsius_ + 273.15; }

    constexpr auto operator<=>(const Temperature&) const = default;
    friend constexpr TemperatureDifference operator-(Temperature a, Temperature b) {
        return TemperatureDifference::from_si(a.celsius_ - b.celsius_);
    }
    friend constexpr Temperature operator+(Temperature a, TemperatureDifference d) {
        return Temperature{a.celsius_ + d.si()};
    }
    friend constexpr Temperature operator-(Temperature a, TemperatureDifference d) {
        return Temperature{a.celsius_ - d.si()};
    }

private:
    explicit constexpr Temperature(double celsius)
        : celsius_{celsius} {}
    double celsius_{};
};

/// The reference temperature of length measurement (ISO 1).
inline constexpr Temperature reference_temperature = Temperature::celsius(20.0);

inline namespace literals {
constexpr Temperature operator""_degC(long double v) {
    return Temperature::celsius(static_cast<double>(v));
}
} // namespace literals

} // namespace axiscal
