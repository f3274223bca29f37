#pragma once
// What kind of test a run is. Pure data.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace axiscal {

/// positioning: ISO 230-2, a linear or a rotary axis; circular: ISO 230-4; drift: ISO/TR 230-9 and
/// ISO 230-3, an axis or a ballbar at rest; probing: ISO 230-10; straightness: ISO 230-1, the
/// motion of a linear axis in one direction across it; squareness: ISO 230-1, of two linear axes.
enum class TestKind : std::uint8_t {
    positioning,
    circular,
    drift,
    probing,
    straightness,
    squareness
};

constexpr std::string_view name_of(TestKind kind) {
    switch (kind) {
    case TestKind::positioning: return "positioning";
    case TestKind::circular: return "circular";
    case TestKind::drift: return "drift";
    case TestKind::probing: return "probing";
    case TestKind::straightness: return "straightness";
    case TestKind::squareness: return "squareness";
    }
    return "?";
}

/// In their order.
inline constexpr std::array all_test_kinds{TestKind::positioning, TestKind::circular,
                                           TestKind::drift, TestKind::probing,
                                           TestKind::straightness, TestKind::squareness};

/// Nothing where no kind has this name.
constexpr std::optional<TestKind> kind_named(std::string_view name) {
    for (const TestKind kind : all_test_kinds)
        if (name == name_of(kind)) return kind;
    return std::nullopt;
}

} // namespace axiscal
