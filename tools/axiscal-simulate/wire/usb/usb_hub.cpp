#include "wire/usb/usb_hub.hpp"

#include "wire/usb/gadget_carrier.hpp"
#include "wire/usb/uhid_carrier.hpp"
#include "wire/usb/vhci_port.hpp"

#include <algorithm>
#include <sstream>

namespace axiscal::simulate {

namespace {

Result<std::unique_ptr<UsbCarrier>>
carry(const UsbWish& wish, std::unique_ptr<UsbDevice> device, int& next_port) {
    const std::string name = wish.text("called", wish.kind);
    const std::string carrier = wish.text("carrier", "vhci");
    if (carrier == "vhci") return std::make_unique<VhciPort>(next_port++, name, std::move(device));
    if (carrier == "uhid") return std::make_unique<UhidCarrier>(name, std::move(device));
    if (carrier == "dummy-hcd") return std::make_unique<GadgetCarrier>(name, std::move(device));
    return fail(Fault::bad_request,
                "\"" + carrier + "\" is none of the carriers vhci, uhid, dummy-hcd");
}

} // namespace

Result<std::unique_ptr<UsbHub>>
UsbHub::open(const std::vector<std::string>& wishes, const UsbWorld& world, int first_port) {
    auto hub = std::make_unique<UsbHub>();
    int next_port = first_port;
    for (const std::string& text : wishes) {
        AXISCAL_TRY(const UsbWish wish, parse_usb_wish(text));
        AXISCAL_TRY(auto device, make_usb_device(wish, world));
        AXISCAL_TRY(auto carrier, carry(wish, std::move(device), next_port));
        hub->carriers_.push_back(std::move(carrier));
        if (wish.text("plugged", "yes") == "no") continue;
        auto plugged = hub->carriers_.back()->plug();
        if (!plugged) return tl::unexpected<Error>(plugged.error());
    }
    return hub;
}

nlohmann::json UsbHub::status() const {
    nlohmann::json devices = nlohmann::json::object();
    for (const auto& carrier : carriers_)
        devices[carrier->name()] = {{"plugged", carrier->plugged()},
                                    {"state", carrier->state()},
                                    {"skipped", carrier->skipped()}};
    return {{"ready", true}, {"devices", devices}};
}

Result<void> UsbHub::obey(const std::string& word, std::istream& arguments) {
    std::string name, fault;
    int number = 0;
    arguments >> name;
    const auto found = std::find_if(carriers_.begin(), carriers_.end(),
                                    [&](const auto& carrier) { return carrier->name() == name; });
    if (found == carriers_.end())
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
