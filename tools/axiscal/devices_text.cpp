#include "tools/axiscal/devices_text.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdio>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 7> wire_names{"serial", "usb",      "hid",    "tcp",
                                                "can",    "one-wire", "counter"};

Json usb_json(const UsbEntry& usb) {
    char numbers[16];
    std::snprintf(numbers, sizeof numbers, "%04x:%04x", unsigned{usb.vendor},
                  unsigned{usb.product});
    return {{"id", numbers}, {"name", usb.name}, {"serial", usb.serial}, {"port", usb.port}};
}

std::string indented(const std::string& block, const std::string& by) {
    std::string text;
    for (std::size_t at = 0; at < block.size();) {
        const std::size_t end = block.find('\n', at);
        text += by + block.substr(at, end - at) + "\n";
        at = end == std::string::npos ? block.size() : end + 1;
    }
    return text;
}

std::string headline(const Json& device) {
    std::string text = device.at("place").get<std::string>();
    if (const Json& usb = device.at("usb"); !usb.is_null()) {
        text += "   USB " + usb.at("id").get<std::string>();
        if (usb.at("name") != "") text += " " + usb.at("name").get<std::string>();
        if (usb.at("serial") != "")
            text += ", serial number " + usb.at("serial").get<std::string>();
    }
    for (const Json& sensor : device.at("sensors"))
        text += "   " + sensor.get<std::string>();
    return text + "\n";
}

std::string could_be_text(const Json& device, bool blocks) {
    const Json& drivers = device.at("could_be");
    if (drivers.empty()) return "    no driver of axiscal is known for it\n";
    std::string text;
    for (const Json& item : drivers)
        text += "    could be " + item.at("driver").get<std::string>() + ": " +
                item.at("summary").get<std::string>() + "\n";
    const bool shared = device.at("wire") == "can"; // a bus has room for more
    if (!device.at("in_station").is_null() && !shared) return text;
    if (drivers.size() > 1 && !blocks)
        return text +
               "    axiscal devices --as DRIVER shows the lines to add to the station file\n";
    for (const Json& item : drivers)
        text += "    to add it to the station file, append:\n" +
                indented(item.at("block").get<std::string>(), "        ");
    return text;
}

} // namespace

Json device_json(const PluggedDevice& device, const StationWires& station, const Account& service) {
    Json drivers = Json::array();
    for (const InstrumentDriver* driver : could_be(device))
        drivers.push_back({{"driver", driver->name},
                           {"summary", driver->summary},
                           {"block", toml_block(device, *driver, station)}});
    Json missing = Json::array();
    for (const Obstacle& obstacle : obstacles(device, service))
        missing.push_back({{"what", obstacle.what}, {"mend", obstacle.mend}});
    const std::string name = known_as(device, station);
    return {{"place", device.place},
            {"wire", wire_names[static_cast<std::size_t>(device.wire)]},
            {"node", device.node},
            {"link", device.link},
            {"usb", device.usb ? usb_json(*device.usb) : Json{}},
            {"sensors", device.sensors},
            {"kernel_driver", device.kernel_driver},
            {"could_be", std::move(drivers)},
            {"in_station", name.empty() ? Json{} : Json(name)},
            {"may_be", may_be(device, station)},
            {"missing", std::move(missing)}};
}

std::string device_text(const Json& device, bool blocks) {
    std::string text = headline(device) + could_be_text(device, blocks);
    if (!device.at("in_station").is_null())
        text +=
            "    in the station file as \"" + device.at("in_station").get<std::string>() + "\"\n";
    for (const Json& name : device.at("may_be"))
        text += "    may be \"" + name.get<std::string>() +
                "\" of the station file: its serial number can be read only when it is opened\n";
    for (const Json& item : device.at("missing"))
        text += "    MISSING: " + item.at("what").get<std::string>() + "\n        " +
                item.at("mend").get<std::string>() + "\n";
    return text;
}

} // namespace axiscal
