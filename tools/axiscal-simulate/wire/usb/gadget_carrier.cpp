// Source: Linux 6.1, Documentation/usb/gadget_configfs.rst, gadget_hid.rst and
// Documentation/ABI/testing/configfs-usb-gadget-hid.
#include "wire/usb/gadget_carrier.hpp"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <fstream>
#include <poll.h>
#include <unistd.h>

namespace axiscal::simulate {

namespace {

namespace fs = std::filesystem;

constexpr const char* gadgets = "/sys/kernel/config/usb_gadget";
constexpr const char* controller = "dummy_udc.0";

std::string hexadecimal(std::uint16_t number) {
    char text[8];
    std::snprintf(text, sizeof text, "0x%04x", unsigned{number});
    return text;
}

/// One write: configfs takes an attribute as a whole.
Result<void> put(const fs::path& attribute, std::string_view text) {
    const int file = ::open(attribute.c_str(), O_WRONLY | O_CLOEXEC);
    const bool written = file >= 0 && ::write(file, text.data(), text.size()) >= 0;
    const std::error_code why{errno, std::generic_category()};
    if (file >= 0) ::close(file);
    if (written) return {};
    return fail(Fault::io,
                attribute.string() + " can not be written; are dummy_hcd and usb_f_hid "
                                     "loaded, and is this root?",
                why);
}

Result<void> make_folder(const fs::path& folder) {
    std::error_code why;
    fs::create_directory(folder, why);
    if (!why) return {};
    return fail(Fault::io,
                folder.string() + " can not be made; is configfs mounted, and are "
                                  "libcomposite and usb_f_hid loaded?",
                why);
}

std::string function_name(const HidInterface& interface) {
    return "hid.i" + std::to_string(interface.number);
}

} // namespace

GadgetCarrier::GadgetCarrier(std::string name, std::unique_ptr<UsbDevice> device)
    : UsbCarrier{std::move(name), std::move(device)}
    , tree_{fs::path{gadgets} / this->name()} {}

Result<void> GadgetCarrier::describe_gadget() {
    const UsbDescriptors& descriptors = device().descriptors();
    AXISCAL_CHECK(make_folder(tree_));
    AXISCAL_CHECK(put(tree_ / "idVendor", hexadecimal(descriptors.vendor)));
    AXISCAL_CHECK(put(tree_ / "idProduct", hexadecimal(descriptors.product)));
    AXISCAL_CHECK(put(tree_ / "bcdDevice", hexadecimal(descriptors.release)));
    AXISCAL_CHECK(make_folder(tree_ / "configs/c.1"));
    if (descriptors.maker.empty() && descriptors.name.empty() && descriptors.serial.empty())
        return {};
    AXISCAL_CHECK(make_folder(tree_ / "strings/0x409"));
    AXISCAL_CHECK(put(tree_ / "strings/0x409/manufacturer", descriptors.maker));
    AXISCAL_CHECK(put(tree_ / "strings/0x409/product", descriptors.name));
    return put(tree_ / "strings/0x409/serialnumber", descriptors.serial);
}

/// Reports to the device come by SET_REPORT on endpoint 0, as the models have it.
Result<void> GadgetCarrier::add_function(const HidInterface& interface) {
    const fs::path function = tree_ / "functions" / function_name(interface);
    AXISCAL_CHECK(make_folder(function));
    AXISCAL_CHECK(put(function / "no_out_endpoint", "1"));
    AXISCAL_CHECK(put(function / "subclass", std::to_string(interface.subclass)));
    AXISCAL_CHECK(put(function / "protocol", std::to_string(interface.protocol)));
    AXISCAL_CHECK(put(function / "report_length", std::to_string(interface.longest_report)));
    const Bytes& reports = interface.report_descriptor;
    AXISCAL_CHECK(put(function / "report_desc", std::string{reports.begin(), reports.end()}));
    std::error_code why;
    fs::create_symlink(function, tree_ / "configs/c.1" / function_name(interface), why);
    if (!why) return {};
    return fail(Fault::io, function.string() + " does not fit into the configuration", why);
}

/// On with the controller; the kernel then makes /dev/hidgN, N being the minor number.
Result<std::vector<GadgetCarrier::End>>
GadgetCarrier::connect(const std::vector<HidInterface>& interfaces) {
    AXISCAL_CHECK(put(tree_ / "UDC", controller));
    std::vector<End> ends;
    ends.reserve(interfaces.size());
    for (const HidInterface& interface : interfaces) {
        std::ifstream numbers{tree_ / "functions" / function_name(interface) / "dev"};
        std::string major, minor;
        std::getline(numbers, major, ':');
        std::getline(numbers, minor);
        const std::string node = "/dev/hidg" + minor;
        const int descriptor = ::open(node.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);
        if (descriptor < 0) {
            const std::error_code why{errno, std::generic_category()};
            for (const End& end : ends)
                ::close(end.descriptor);
            return fail(Fault::io, node + " can not be opened", why);
        }
        ends.push_back({interface, descriptor, {}});
    }
    return ends;
}

void GadgetCarrier::exchange(End& end, bool readable) {
    Bytes report(end.interface.longest_report);
    const ssize_t got = readable ? ::read(end.descriptor, report.data(), report.size()) : -1;
    if (got > 0 && faults().fault() != UsbFault::mute)
        give_report(device(), end.interface, {report.data(), static_cast<std::size_t>(got)});
    if (end.waiting.empty()) end.waiting = next_report(device(), faults(), end.interface);
    if (end.waiting.empty()) return;
    const ssize_t sent = ::write(end.descriptor, end.waiting.data(), end.waiting.size());
    if (sent >= 0 || errno != EAGAIN) end.waiting.clear();
}

void GadgetCarrier::serve(std::vector<End>& ends, const std::stop_token& stop) {
    std::vector<pollfd> polls;
    polls.reserve(ends.size());
    for (const End& end : ends)
        polls.push_back({end.descriptor, POLLIN, 0});
    while (!stop.stop_requested()) {
        ::poll(polls.data(), polls.size(), static_cast<int>(device().pace().count()));
        for (std::size_t i = 0; i < ends.size(); ++i)
            exchange(ends[i], (polls[i].revents & POLLIN) != 0);
    }
}

Result<void> GadgetCarrier::plug() {
    unplug();
    take_down(); // of one that died
    const auto interfaces = hid_interfaces(device());
    if (interfaces.empty()) return fail(Fault::bad_request, name() + " is no HID device");
    auto made = describe_gadget();
    for (const HidInterface& interface : interfaces)
        if (made) made = add_function(interface);
    auto ends =
        made ? connect(interfaces) : Result<std::vector<End>>{tl::unexpected<Error>(made.error())};
    if (!ends) {
        take_down();
        return tl::unexpected<Error>(ends.error());
    }
    device().plugged();
    start_pump(std::jthread{[this, held = *std::move(ends)](const std::stop_token& stop) mutable {
        serve(held, stop);
        for (const End& end : held)
            ::close(end.descriptor);
    }});
    return {};
}

/// From the outside in, as configfs wants it; what is not there is passed over.
void GadgetCarrier::take_down() {
    std::error_code ignored;
    if (!fs::exists(tree_, ignored)) return;
    (void)put(tree_ / "UDC", "\n");
    for (const char* folder : {"configs/c.1", "functions"}) {
        std::vector<fs::path> inside;
        for (const auto& entry : fs::directory_iterator{tree_ / folder, ignored})
            if (entry.path().filename().string().starts_with("hid.i")) inside.push_back(entry);
        for (const fs::path& entry : inside)
            fs::remove(entry, ignored);
    }
    fs::remove(tree_ / "configs/c.1", ignored);
    fs::remove(tree_ / "strings/0x409", ignored);
    fs::remove(tree_, ignored);
}

void GadgetCarrier::unplug() {
    if (!plugged()) return;
    (void)put(tree_ / "UDC", "\n");
    stop_pump();
    take_down();
}

} // namespace axiscal::simulate
