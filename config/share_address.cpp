#include "config/share_address.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <vector>

namespace axiscal {
namespace {

constexpr std::string_view scheme = "smb://";
constexpr int usual_port = 445, highest_port = 65535;
// What SMB allows in no name, and what an address would be read wrongly with.
constexpr std::string_view never_in_names = "<>:\"|?*\\%\x7f";

tl::unexpected<Error> bad(const std::string& reason) {
    return fail(Fault::bad_request, reason + "; write \"smb://server/share/folder\"");
}

std::vector<std::string> split(std::string_view text) {
    std::vector<std::string> parts;
    while (!text.empty()) {
        const auto end = std::min(text.find('/'), text.size());
        if (end > 0) parts.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return parts;
}

Result<void> check_name(const std::string& name) {
    const bool printable = std::ranges::none_of(name, [](unsigned char byte) {
        return byte < ' ' || never_in_names.find(static_cast<char>(byte)) != std::string_view::npos;
    });
    if (printable && name != "." && name != "..") return {};
    return bad("\"" + name +
               "\" can be no name on a share (names stand as they are shown, without "
               "% escapes)");
}

Result<void> read_server(std::string_view text, ShareAddress& address) {
    if (text.find('@') != std::string_view::npos)
        return bad("the account does not belong in the address, but in the file of "
                   "publish.credentials");
    const auto colon = text.find(':');
    address.server = text.substr(0, colon);
    constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                         "0123456789.-_";
    if (address.server.empty() || address.server.find_first_not_of(allowed) != std::string::npos)
        return bad("\"" + address.server + "\" is no server's name");
    if (colon == std::string_view::npos) return {};
    const std::string_view digits = text.substr(colon + 1);
    const char* const end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, address.port);
    if (error != std::errc{} || stop != end || address.port < 1 || address.port > highest_port)
        return bad("\"" + std::string{digits} + "\" is no port");
    return {};
}

} // namespace

bool is_share_address(std::string_view text) {
    const auto lower = [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); };
    std::string begin{text.substr(0, scheme.size())};
    std::ranges::transform(begin, begin.begin(), lower);
    return begin == scheme || text.starts_with("\\\\");
}

Result<ShareAddress> parse_share_address(std::string_view text) {
    if (!text.starts_with(scheme)) return bad("\"" + std::string{text} + "\" is no such address");
    text.remove_prefix(scheme.size());
    const auto slash = std::min(text.find('/'), text.size());
    ShareAddress address;
    AXISCAL_CHECK(read_server(text.substr(0, slash), address));
    const auto names = split(text.substr(slash));
    for (const auto& name : names)
        AXISCAL_CHECK(check_name(name));
    if (names.empty()) return bad("the share is missing");
    address.share = names.front();
    for (std::size_t i = 1; i < names.size(); ++i)
        address.folder += (i > 1 ? "/" : "") + names[i];
    return address;
}

std::string address_text(const ShareAddress& address) {
    std::string text = std::string{scheme} + address.server;
    if (address.port != usual_port) text += ":" + std::to_string(address.port);
    text += "/" + address.share;
    return address.folder.empty() ? text : text + "/" + address.folder;
}

} // namespace axiscal
