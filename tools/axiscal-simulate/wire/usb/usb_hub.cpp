#include "wire/usb/usb_hub.hpp"

#include <algorithm>
#include <sstream>

namespace axiscal::simulate {

Result<std::unique_ptr<UsbHub>>
UsbHub::open(const std::vector<std::string>& wishes, const UsbWorld& world, int first_port) {
    auto hub = std::make_unique<UsbHub>();
    for (const std::string& text : wishes) {
        AXISCAL_TRY(const UsbWish wish, parse_usb_wish(text));
        AXISCAL_TRY(auto device, make_usb_device(wish, world));
        const int port = first_port + static_cast<int>(hub->ports_.size());
        hub->ports_.push_back(
            std::make_unique<VhciPort>(port, wish.text("called", wish.kind), std::move(device)));
        if (wish.text("plugged", "yes") == "no") continue;
        auto plugged = hub->ports_.back()->plug();
        if (!plugged) return tl::unexpected<Error>(plugged.error());
    }
    return hub;
}

nlohmann::json UsbHub::status() const {
    nlohmann::json devices = nlohmann::json::object();
    for (const auto& port : ports_)
        devices[port->name()] = {{"plugged", port->plugged()}, {"state", port->state()}};
    return {{"ready", true}, {"devices", devices}};
}

Result<void> UsbHub::obey(const std::string& word, std::istream& arguments) {
    std::string name, fault;
    int number = 0;
    arguments >> name;
    const auto found = std::find_if(ports_.begin(), ports_.end(),
                                    [&](const auto& port) { return port->name() == name; });
    if (found == ports_.end())
        return fail(Fault::not_found, "no device is called \"" + name + "\"");
    if (word == "plug") return (*found)->plug();
    if (word == "unplug") return (*found)->unplug(), Result<void>{};
    if (word == "tell") {
        arguments >> fault;
        return (*found)->obey(fault);
    }
    if (word != "fault") return fail(Fault::bad_request, "\"" + word + "\" is no command");
    arguments >> fault >> number;
    return (*found)->faults().set(fault, number);
}

nlohmann::json UsbHub::command(const std::string& line) {
    std::istringstream arguments{line};
    std::string word;
    arguments >> word;
    if (word == "status") return status();
    if (word == "quit") return ended_ = true, nlohmann::json{{"ok", true}};
    const auto done = obey(word, arguments);
    if (done) return {{"ok", true}};
    return {{"ok", false}, {"error", describe(done.error())}};
}

} // namespace axiscal::simulate
