#pragma once
// A double that knows its dimension. Eight bytes, no conversion in or out except by a named unit.
// Class is pure: no I/O, no allocation.

#include <compare>
#include <concepts>

namespace axiscal {

/// A physical amount of one dimension, held in SI. Made by `mm(0.5)` or `0.5_mm`, read by
/// `.in(mm)`.
template <class Dimension> class Quantity {
public:
    constexpr Quantity() = default;
    static constexpr Quantity from_si(double si_amount) { return Quantity{si_amount}; }
    [[nodiscard]] constexpr double si() const { return amount_; }
    /// The number of `unit`s in this amount: `length.in(um)`.
    template <class Unit>
    requires std::same_as<typename Unit::dimension, Dimension>
    [[nodiscard]] constexpr double in(Unit unit) const { return amount_ / unit.size; }

    constexpr auto operator<=>(const Quantity&) const = default;
    constexpr Quantity operator-() const { return Quantity{-amount_}; }
    constexpr Quantity& operator+=(Quantity other) { return amount_ += other.amount_, *this; }
    constexpr Quantity& operator-=(Quantity other) { return amount_ -= other.amount_, *this; }
    friend constexpr Quantity operator+(Quantity a, Quantity b) {
        return Quantity{a.amount_ + b.amount_};
    }
    friend constexpr Quantity operator-(Quantity a, Quantity b) {
        return Quantity{a.amount_ - b.amount_};
    }
    friend constexpr Quantity operator*(Quantity a, double k) { return Quantity{a.amount_ * k}; }
    friend constexpr Quantity operator*(double k, Quantity a) { return Quantity{a.amount_ * k}; }
    friend constexpr Quantity operator/(Quantity a, double k) { return Quantity{a.amount_ / k}; }
    friend constexpr double operator/(Quantity a, Quantity b) { return a.amount_ / b.amount_; }
    friend constexpr Quantity abs(Quantity a) { return a.amount_ < 0 ? -a : a; }

private:
    explicit constexpr Quantity(double si_amount)
        : amount_{si_amount} {}
    double amount_{};
};

/// A unit: its size in SI. Calling it makes a quantity: `mm(0.5)`.
template <class Dimension> struct Unit {
    using dimension = Dimension;
    double size;
    constexpr Quantity<Dimension> operator()(double count) const {
        return Quantity<Dimension>::from_si(count * size);
    }
};

struct LengthDimension;
struct AngleDimension;
struct SpeedDimension;
struct PressureDimension;
struct RatioDimension;
struct TemperatureDifferenceDimension;
struct ExpansionDimension;

using Length = Quantity<LengthDimension>;
using Angle = Quantity<AngleDimension>;
using Speed = Quantity<SpeedDimension>;
using Pressure = Quantity<PressureDimension>;
using Ratio = Quantity<RatioDimension>;
using TemperatureDifference = Quantity<TemperatureDifferenceDimension>;
/// Coefficient of linear thermal expansion, 1/K.
using Expansion = Quantity<ExpansionDimension>;

inline constexpr Unit<LengthDimension> metre{1.0}, mm{1e-3}, um{1e-6}, nm{1e-9}, inch{25.4e-3};
inline constexpr Unit<AngleDimension> radian{1.0}, degree{3.14159265358979323846 / 180.0},
    arcsec{3.14159265358979323846 / 648000.0};
inline constexpr Unit<SpeedDimension> metre_per_second{1.0}, mm_per_minute{1e-3 / 60.0};
inline constexpr Unit<PressureDimension> pascal{1.0}, hectopascal{100.0};
inline constexpr Unit<RatioDimension> unity{1.0}, percent{1e-2}, ppm{1e-6};
inline constexpr Unit<TemperatureDifferenceDimension> kelvin{1.0};
inline constexpr Unit<ExpansionDimension> per_kelvin{1.0}, um_per_m_kelvin{1e-6};

constexpr Length operator*(Ratio r, Length l) {
    return l * r.si();
}
constexpr Ratio operator*(Expansion a, TemperatureDifference d) {
    return Ratio::from_si(a.si() * d.si());
}

inline namespace literals {
constexpr Length operator""_m(long double v) {
    return metre(static_cast<double>(v));
}
constexpr Length operator""_mm(long double v) {
    return mm(static_cast<double>(v));
}
constexpr Length operator""_um(long double v) {
    return um(static_cast<double>(v));
}
constexpr Length operator""_nm(long double v) {
    return nm(static_cast<double>(v));
}
constexpr TemperatureDifference operator""_K(long double v) {
    return kelvin(static_cast<double>(v));
}
constexpr Expansion operator""_per_K(long double v) {
    return per_kelvin(static_cast<double>(v));
}
constexpr Pressure operator""_Pa(long double v) {
    return pascal(static_cast<double>(v));
}
constexpr Pressure operator""_hPa(long double v) {
    return hectopascal(static_cast<double>(v));
}
} // namespace literals

} // namespace axiscal
