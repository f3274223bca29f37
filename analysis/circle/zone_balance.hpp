#pragma once
// The linear heart of the minimum zone: which small step makes the greatest |distance| of a few
// points from a circle least. Pure.

#include "analysis/circle/seen_circle.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace axiscal::circle {

/// A point as the circle sees it: e - v . step is its distance after a small step.
struct Bearing {
    double e = 0, vx = 0, vy = 0;
};
Bearing bearing_of(double from_x, double from_y, const SeenCircle& circle);

/// Some of the points, in coordinates from the circle's origin, and their bearings.
class WorkingSet {
public:
    /// False if it holds the point already.
    bool add(std::size_t index, double from_x, double from_y);
    /// For a point that it cannot hold yet.
    void append(std::size_t index, double from_x, double from_y);
    /// Takes the bearings from this circle.
    void see_from(const SeenCircle& circle);
    /// Largest minus smallest distance from this circle; the bearings stay.
    [[nodiscard]] double width_from(const SeenCircle& circle) const;

    [[nodiscard]] std::size_t size() const { return index_.size(); }
    [[nodiscard]] std::size_t index(std::size_t place) const { return index_[place]; }
    [[nodiscard]] const std::vector<Bearing>& bearings() const { return bearings_; }

private:
    std::vector<std::size_t> index_;
    std::vector<double> from_x_, from_y_;
    std::vector<Bearing> bearings_;
};

using FourPlaces = std::array<std::size_t, 4>; ///< in a working set

/// Four points with weights such that sum w (v, 1) = 0. No step makes their greatest |distance|
/// less than |sum w e| / sum |w|: the bound that certifies an optimum.
struct Balance {
    FourPlaces places{};
    std::array<double, 4> weights{}; ///< positive: outer side; |weights| add up to 1
    double half_width = -1;          ///< the bound; negative: the directions allow none
    CircleStep step;                 ///< levels the four points at +- half_width
};

/// The bound of four points, with its step.
Balance balance_of(const WorkingSet& set, const FourPlaces& places);

/// The best step for the whole set, by single exchange: the point that lies furthest out replaces
/// that of the four which leaves the highest bound (E. Remez; a dual simplex of four rows).
/// `start`: any four; they are replaced where they allow no bound.
Balance balance(const WorkingSet& set, const FourPlaces& start);

} // namespace axiscal::circle
