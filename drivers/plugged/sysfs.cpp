#include "drivers/plugged/sysfs.hpp"

#include <algorithm>
#include <fstream>

namespace axiscal::sysfs {

namespace fs = std::filesystem;

std::string line_of(const fs::path& file) {
    std::ifstream stream{file};
    std::string text;
    std::getline(stream, text);
    return text;
}

std::vector<fs::path> entries(const fs::path& folder) {
    std::vector<fs::path> found;
    std::error_code error;
    for (fs::directory_iterator at{folder, error}, end; !error && at != end; at.increment(error))
        found.push_back(at->path());
    std::ranges::sort(found);
    return found;
}

std::string target_name(const fs::path& link) {
    std::error_code error;
    const fs::path target = fs::read_symlink(link, error);
    return error ? std::string{} : target.filename().string();
}

std::optional<UsbEntry> usb_above(const fs::path& device, const std::vector<UsbEntry>& plugged) {
    std::error_code error;
    for (fs::path at = fs::canonical(device, error); !error && at.has_relative_path();
         at = at.parent_path()) {
        if (!fs::exists(at / "idVendor", error)) continue;
        const auto found = std::ranges::find(plugged, at.filename().string(), &UsbEntry::port);
        if (found != plugged.end()) return *found;
    }
    return std::nullopt;
}

} // namespace axiscal::sysfs
