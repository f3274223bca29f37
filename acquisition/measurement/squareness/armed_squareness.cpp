#include "acquisition/measurement/squareness/armed_squareness.hpp"

#include "acquisition/measurement/straightness/armed_straightness.hpp"

#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace axiscal {
namespace {

std::string option_or(const ArmRequest& request, const char* name, const std::string& stated) {
    const auto said = request.options.find(name);
    return said == request.options.end() ? stated : said->second;
}

} // namespace

std::optional<SquareTables> square_tables_of(const StationConfig& station) {
    const StraightnessConfig* const across = straightness_config_of(station);
    const SquarenessConfig* const square = squareness_config_of(station);
    if (across == nullptr || square == nullptr) return std::nullopt;
    return SquareTables{*across, *square};
}

Result<SquarePosition> square_of(const SquarenessConfig& config, const ArmRequest& request) {
    const auto said = request.options.find("square");
    if (said == request.options.end()) return config.square;
    for (const SquarePosition position : {SquarePosition::normal, SquarePosition::turned})
        if (said->second == name_of(position)) return position;
    return refuse(Fault::bad_request, "options.square",
                  "'" + said->second +
                      "' is no position of the optical square: say normal, or turned where its "
                      "error counts with the other sign");
}

Result<SquarenessSetup> squareness_before_lines(const SquareTables& tables,
                                                const ArmRequest& request) {
    SquarenessSetup setup;
    setup.optics = tables.across.setup;
    AXISCAL_TRY(setup.optics.mirror, mirror_of(tables.across, request));
    AXISCAL_TRY(setup.square, square_of(tables.square, request));
    setup.stated = tables.square.stated;
    return setup;
}

WantedRun wanted_first_line(const SquareTables& tables, const ArmRequest& request) {
    return {TestKind::straightness, option_or(request, "first", tables.square.first),
            tables.across.setup.across, "squareness.first"};
}

std::optional<WantedRun> wanted_other_square(const StationConfig& station,
                                             const SquareTables& tables,
                                             const ArmRequest& request) {
    std::string which = option_or(request, "reversal_of", tables.square.reversal_of);
    if (which.empty()) return std::nullopt;
    const std::string& stated = station.statements.axis;
    return WantedRun{TestKind::squareness, std::move(which),
                     stated.empty() ? station.axis.name : stated, "squareness.reversal_of"};
}

Result<ArmedRun> armed_squareness(const RunHeaderParts& parts,
                                  const SquareTables& tables,
                                  const ArmRequest& request,
                                  const std::optional<FoundEve>& eve,
                                  SquarenessSetup setup) {
    AXISCAL_TRY(ArmedRun armed,
                armed_straightness(parts, tables.across, request, eve, std::nullopt));
    setup.optics = std::get<StraightnessSetup>(std::move(armed.attachments.setup));
    armed.attachments.setup = std::move(setup);
    armed.header.instruments.push_back(tables.square.artefact);
    return armed;
}

} // namespace axiscal
