#include "tools/axiscal/devices_command.hpp"

#include "config/json_text.hpp"
#include "drivers/registry.hpp"
#include "tools/axiscal/devices_text.hpp"
#include "tools/axiscal/exit_code.hpp"
#include "tools/axiscal/status_text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iostream>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

/// The instruments of a running station, or the sentence why there are none to show.
struct StationPart {
    Json instruments; ///< null without an answer
    std::string note;
    int code = exit_no_contact; ///< where nothing else can be shown
};

StationPart ask_station(const StationClient& client) {
    const auto reply = client.get("/v1/instruments");
    if (!reply)
        return {Json{}, reply.error().detail,
                reply.error().fault == Fault::bad_request ? exit_usage : exit_no_contact};
    const Json body = Json::parse(reply->body, nullptr, false);
    if (reply->status >= 300 || !body.is_array())
        return {Json{}, "the station answered " + std::to_string(reply->status)};
    return {body, ""};
}

struct FilePart {
    StationWires wires;
    std::string note;
};

FilePart read_file(const std::string& path) {
    if (!std::filesystem::exists(path))
        return {{}, "There is no station file " + path + "; --config names another one."};
    auto document = SettingsDocument::load(path);
    if (!document) return {{}, document.error().detail};
    return {read_station_wires(*document), ""};
}

bool could_be_of(const Json& device, const std::string& driver) {
    return driver.empty() || std::ranges::any_of(device.at("could_be"), [&](const Json& item) {
               return item.at("driver") == driver;
           });
}

Json plugged_json(const DevicesRequest& request, const StationWires& wires) {
    const Account service = service_account();
    Json list = Json::array();
    for (const PluggedDevice& device : list_plugged(request.places)) {
        Json item = device_json(device, wires, service);
        if (!could_be_of(item, request.driver)) continue;
        Json& drivers = item.at("could_be");
        for (std::size_t i = drivers.size(); !request.driver.empty() && i-- > 0;)
            if (drivers[i].at("driver") != request.driver) drivers.erase(i);
        list.push_back(std::move(item));
    }
    return list;
}

void print(const StationPart& station, const FilePart& file, const Json& plugged, bool blocks) {
    std::cout << "Instruments of the station\n"
              << (station.instruments.is_null() ? "  " + station.note + "\n"
                                                : instruments_text(station.instruments))
              << "Plugged in\n";
    if (!file.note.empty()) std::cout << "  " << file.note << "\n";
    if (plugged.empty()) std::cout << "  nothing that axiscal knows\n";
    for (const Json& device : plugged)
        std::cout << "  " << device_text(device, blocks);
}

} // namespace

int command_devices(const StationClient& client, const DevicesRequest& request, bool json) {
    if (!request.driver.empty())
        if (const auto driver = find_driver(request.driver); !driver)
            return std::cerr << driver.error().detail << "\n", exit_usage;
    const StationPart station = ask_station(client);
    const FilePart file = read_file(request.station_file);
    const Json plugged = plugged_json(request, file.wires);
    if (json)
        std::cout << json_text(Json{{"instruments", station.instruments},
                                    {"station", station.note},
                                    {"station_file", file.note},
                                    {"plugged", plugged}})
                  << "\n";
    else
        print(station, file, plugged, !request.driver.empty());
    return exit_ok;
}

int command_far_devices(const StationClient& client, bool json) {
    const StationPart station = ask_station(client);
    if (station.instruments.is_null()) return std::cerr << station.note << "\n", station.code;
    if (json)
        std::cout << json_text(Json{{"instruments", station.instruments}, {"plugged", nullptr}})
                  << "\n";
    else
        std::cout << instruments_text(station.instruments);
    return exit_ok;
}

int command_list_drivers(bool json) {
    Json list = Json::array();
    for (const InstrumentDriver& driver : instrument_drivers()) {
        list.push_back({{"driver", driver.name}, {"summary", driver.summary}});
        if (!json)
            std::cout << "  " << std::left << std::setw(13) << driver.name << driver.summary
                      << "\n";
    }
    if (json) std::cout << json_text(list) << "\n";
    return exit_ok;
}

} // namespace axiscal
