#include "acquisition/measurement/circular/armed_circles.hpp"

#include "acquisition/runfile/certificate_numbers.hpp"

#include <utility>

namespace axiscal {
namespace {

Result<RunRecord> header_of_circles(const RunHeaderParts& parts, const ArmRequest& request) {
    const StationConfig& config = parts.config;
    const std::string plane{name_of(config.circular->setup.plan.plane)};
    AXISCAL_TRY(RunRecord header, make_header_without_axis(parts, plane + "-circle", request));
    AXISCAL_CHECK(
        check_number_is_free(config.state_directory, header.statements.certificate_number));
    header.plan.remark = "circular test; the table circular holds its plan";
    header.statements.axis = plane;
    return header;
}

} // namespace

Result<ArmedCircles> armed_circles(const RunHeaderParts& parts,
                                   const ArmRequest& request,
                                   double rate_hz,
                                   const std::optional<FoundEve>& eve) {
    ArmedCircles armed;
    AXISCAL_TRY(armed.header, header_of_circles(parts, request));
    armed.setup = parts.config.circular->setup;
    armed.setup.bar_temperature_channel = parts.roles.bar_temperature;
    armed.setup.capture.sample_rate_hz = rate_hz;
    if (eve) {
        armed.setup.uncertainty.eve_um = eve->eve.in(um);
        armed.eve_source = eve->run_id;
    }
    return armed;
}

} // namespace axiscal
