#include "acquisition/measurement/drift/environmental_variation.hpp"

#include "acquisition/journal/journal.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "acquisition/runfile/stored_drift.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <utility>

namespace axiscal {
namespace {

/// E_VE of a sealed test, one millimetre for one degree of a rotary axis. Nothing where the test
/// was of an axis of the other kind.
std::optional<Length> eve_of(const nlohmann::json& document, AxisKind kind) {
    const nlohmann::json::json_pointer place{"/parameters/E_VE/value"};
    if (!document.is_object() || !document.contains(place) || !document[place].is_number())
        return std::nullopt;
    const double value = document[place].get<double>();
    const bool angle = kind == AxisKind::rotary;
    const nlohmann::json stated = document.value("unit", nlohmann::json("um"));
    if (stated != (angle ? "arcsec" : "um") || value < 0) return std::nullopt;
    constexpr double arcsec_per_degree = 3600;
    return angle ? mm(value / arcsec_per_degree) : um(value);
}

/// How many readings of a sealed test became no coordinate: those may have been its extremes.
/// Tests sealed before this was counted state none.
int refused_readings_in(const nlohmann::json& document) {
    const auto stated = document.is_object() ? document.find("refused_readings") : document.end();
    return stated != document.end() && stated->is_number_integer() ? stated->get<int>() : 0;
}

} // namespace

Task<Result<FoundEve>>
find_eve(Journal& journal, std::string runs_folder, WantedDrift wanted, AxisKind kind) {
    const auto found = co_await journal.find_drift(std::move(runs_folder), wanted);
    if (!found) co_return tl::unexpected<Error>(found.error());
    const auto document = nlohmann::json::parse(found->document, nullptr, false);
    if (const int refused = refused_readings_in(document); refused > 0)
        co_return fail(Fault::refused,
                       "the drift test " + found->run_id + " could not evaluate " +
                           std::to_string(refused) +
                           " of its readings, so that its E_VE may be too small: make another by " +
                           wanted.order() + ", or name a good one in " + wanted.key());
    const std::optional<Length> eve = eve_of(document, kind);
    if (!eve)
        co_return fail(Fault::bad_run_file, "the drift test " + found->run_id +
                                                " states no E_VE in the unit of this " +
                                                (wanted.of_bar ? "ballbar" : "axis"));
    co_return FoundEve{*eve, found->run_id, found->duration, found->place};
}

} // namespace axiscal
