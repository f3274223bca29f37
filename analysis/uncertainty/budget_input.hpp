#pragma once
// An input of an uncertainty budget with where it comes from, and what the run's own readings show
// of it. Pure data.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace axiscal {

enum class InputOrigin : std::uint8_t {
    typed,       ///< a person wrote it into the station file
    certificate, ///< of the certificates of the instruments
    drift_test,  ///< of a drift test that is named
    readings,    ///< of this run
    missing      ///< it is not known, and there is no U of what needs it
};
/// "typed", "certificate", "drift_test", "readings", "missing".
std::string_view name_of(InputOrigin origin);

struct BudgetInput {
    std::string term;            ///< of the budget that it enters: "machine_temperature"
    std::string quantity;        ///< "width of the material's temperature"
    std::string unit;            ///< of `value` and `seen`: "K"
    std::optional<double> value; ///< as the budget uses it
    InputOrigin origin = InputOrigin::missing;
    std::string where;          ///< key of the station file, id of the drift test, readings
    std::optional<double> seen; ///< the least that it must be by the readings of this run
    std::string seen_in;        ///< from what; empty without `seen`
    /// The readings show more than the budget counts: its U is too small.
    [[nodiscard]] bool exceeded() const { return value && seen && *seen > *value; }
};

} // namespace axiscal
