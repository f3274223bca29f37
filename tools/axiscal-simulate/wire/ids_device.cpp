#include "wire/ids_device.hpp"

#include <cmath>

namespace axiscal::simulate {

namespace {

using Json = nlohmann::json;

constexpr int error_beam = 109; // any number but 0: its text is the instrument's own
constexpr int method_not_found = -32601;
constexpr double pm_per_mm = 1e9;

std::string bare(const std::string& method) {
    return method.substr(method.rfind('.') + 1);
}

} // namespace

double IdsDevice::index_used(const IdsReading& now) const {
    if (compensation_mode == 2) return typed_index;
    return unit_connected && compensation_mode == 0 ? now.index : 1;
}

Json IdsDevice::displacement(const Json& parameters, const IdsReading& now) const {
    const int axis = parameters.empty() ? 0 : parameters[0].get<int>();
    if (axis < 0 || axis > 2) return Json::array({1, 0});
    if (!beam) return Json::array({error_beam, 0});
    const double mm = now.vacuum_mm[static_cast<std::size_t>(axis)] / index_used(now);
    return Json::array({0, std::llround(mm * pm_per_mm)});
}

/// Null for a method that it does not have.
Json IdsDevice::result_of(const std::string& method,
                          const Json& parameters,
                          const IdsReading& now) {
    const std::string name = bare(method);
    if (name == "getAxisDisplacement") return displacement(parameters, now);
    if (name == "getAxisSignalQuality")
        return Json::array({0, beam ? std::llround(now.contrast_percent * 10) : 3, 512});
    if (name == "getCurrentMode") return Json::array({0, mode});
    if (name == "startMeasurement") return mode = "measurement starting", Json::array({0});
    if (name == "getSerialNumber") return Json::array({0, serial});
    if (name == "getFirmwareVersion") return Json::array({0, firmware});
    if (name == "getConnected") return Json::array({0, unit_connected});
    if (name == "getRefractiveIndexCompensationMode") return Json::array({0, compensation_mode});
    if (name == "getRefractiveIndexForCompensation") return Json::array({0, index_used(now)});
    if (name == "getRefractiveIndex") return Json::array({0, now.index});
    if (name == "getTemperatureInDegrees") return Json::array({0, now.temperature_degC});
    if (name == "getPressureInHPa") return Json::array({0, now.pressure_hPa});
    if (name == "getHumidityInPercent") return Json::array({0, now.humidity_percent});
    return {};
}

std::string IdsDevice::answer(const std::string& request, const IdsReading& now) {
    const Json asked = Json::parse(request, nullptr, false);
    Json reply{{"jsonrpc", "2.0"}, {"id", nullptr}};
    const bool whole = asked.is_object() && asked.contains("method") && asked.contains("id");
    if (whole) reply["id"] = asked["id"];
    // Without "api":2 the layout is another, which this device does not have.
    const Json result = whole && asked.value("api", 0) == 2
                            ? result_of(asked["method"], asked.value("params", Json::array()), now)
                            : Json{};
    if (result.is_null())
        reply["error"] = {{"code", method_not_found}, {"message", "Method not found"}};
    else
        reply["result"] = result;
    return reply.dump() + "\r\n";
}

std::vector<std::string> take_requests(std::string& pending) {
    std::vector<std::string> requests;
    int depth = 0;
    std::size_t begin = 0;
    for (std::size_t at = 0; at < pending.size(); ++at) {
        if (pending[at] == '{' && depth++ == 0) begin = at;
        if (pending[at] != '}' || depth == 0 || --depth > 0) continue;
        requests.push_back(pending.substr(begin, at + 1 - begin));
        pending.erase(0, at + 1);
        at = static_cast<std::size_t>(-1);
    }
    return requests;
}

} // namespace axiscal::simulate
