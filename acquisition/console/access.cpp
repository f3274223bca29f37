#include "acquisition/console/access.hpp"

#include <algorithm>

namespace axiscal {
namespace {

/// Small letters, whatever the locale.
std::string in_small(std::string_view text) {
    std::string small{text};
    for (char& letter : small)
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    return small;
}

/// As names of computers are compared (RFC 9110, 4.2.3): without case, and without the dot that
/// ends a full name ("bay3.shop.example.:8470").
std::string comparable(std::string_view host) {
    std::string name = in_small(host);
    const std::size_t port =
        name.find(':', name.find(']') == std::string::npos ? 0 : name.find(']'));
    const std::size_t end = std::min(port, name.size());
    if (end > 0 && name[end - 1] == '.') name.erase(end - 1, 1);
    return name;
}

bool is_one_of(std::string_view host, const std::vector<std::string>& hosts) {
    const std::string asked = comparable(host);
    const auto same = [&](const std::string& known) { return comparable(known) == asked; };
    return std::ranges::any_of(hosts, same);
}

/// Without TLS also "https://": another web server may stand before the station.
bool is_origin_of(const std::string& origin, const std::vector<std::string>& hosts, bool tls) {
    const std::string small = in_small(origin);
    for (const std::string_view scheme : {"http://", "https://"})
        if (small.starts_with(scheme))
            return (scheme == "https://" || !tls) &&
                   is_one_of(std::string_view{small}.substr(scheme.size()), hosts);
    return false;
}

/// Browsers leave it out.
constexpr int usual_port(bool tls) {
    return tls ? 443 : 80;
}

/// What stands behind "Bearer ", whose case does not count (RFC 9110, 11.1).
std::string_view bearer_of(std::string_view authorization) {
    constexpr std::string_view scheme = "bearer ";
    if (in_small(authorization.substr(0, scheme.size())) != scheme) return {};
    authorization.remove_prefix(scheme.size());
    while (authorization.starts_with(' '))
        authorization.remove_prefix(1);
    return authorization;
}

/// Browsers send Origin with each POST and DELETE; what sends a cookie without one is no page of
/// the station.
AccessVerdict judge_page(const RequestHead& head, const AccessRules& rules) {
    if (is_origin_of(head.origin, rules.page_hosts, rules.tls))
        return {200, {}, !head.page.empty()};
    return {403, head.origin.empty()
                     ? "A page of the station orders with an Origin header, and there is none; "
                       "programs use the token in the state directory"
                     : "Origin '" + head.origin +
                           "' is not where the station's pages come from; open them by the "
                           "address that 'axiscal pair' prints"};
}

std::string in_brackets(const std::string& host) {
    return host.find(':') == std::string::npos ? host : "[" + host + "]";
}

/// Without brackets' own colons.
bool has_port(const std::string& host) {
    return host.find(':', host.find(']') == std::string::npos ? 0 : host.find(']')) !=
           std::string::npos;
}

} // namespace

bool same_secret(std::string_view given, std::string_view wanted) {
    unsigned difference = given.size() == wanted.size() ? 0U : 1U;
    for (std::size_t i = 0; i < given.size(); ++i)
        difference |= static_cast<unsigned>(
            static_cast<unsigned char>(given[i]) ^
            static_cast<unsigned char>(wanted[i % std::max<std::size_t>(wanted.size(), 1)]));
    return difference == 0 && !wanted.empty();
}

AccessVerdict judge_access(const RequestHead& head, const AccessRules& rules) {
    if (head.door == Door::tcp && !is_one_of(head.host, rules.known_hosts))
        return {421, "Host '" + head.host +
                         "' is not a name of this station; add it to console.allowed_hosts"};
    if (!head.origin.empty() && !is_origin_of(head.origin, rules.known_hosts, rules.tls))
        return {403, "Origin '" + head.origin +
                         "' is foreign; pages of other sites may not talk to the station"};
    if (head.matter == Matter::pairing && head.door == Door::tcp)
        return {403,
                "Browsers are paired at the station itself: axiscal pair, over the Unix socket "
                "(group axiscal)"};
    if (head.matter == Matter::opening_session) return judge_page(head, rules);
    if (!head.changes_state || head.door == Door::unix_socket) return {};
    if (same_secret(bearer_of(head.authorization), rules.token)) return {};
    if (!head.page.empty()) return judge_page(head, rules);
    return {401,
            "Over TCP everybody only reads. A browser orders once it is paired ('axiscal pair' "
            "at the station shows the code), a program by the Unix socket (group axiscal) or "
            "the token in the state directory"};
}

std::vector<std::string>
known_hosts_of(const std::string& host, int port, const std::vector<std::string>& allowed) {
    std::vector<std::string> names{"localhost", "127.0.0.1", "[::1]"};
    names.push_back(in_brackets(host));
    names.insert(names.end(), allowed.begin(), allowed.end());
    const std::size_t bare = names.size();
    for (std::size_t i = 0; i < bare; ++i)
        names.push_back(names[i] + ":" + std::to_string(port));
    return names;
}

std::vector<std::string> page_hosts_of(const std::string& host,
                                       int port,
                                       const std::vector<std::string>& allowed,
                                       bool tls) {
    std::vector<std::string> names = known_hosts_of(host, port, allowed);
    const auto foreign = [&](const std::string& name) {
        return port != usual_port(tls) && !has_port(name) &&
               std::ranges::find(allowed, name) == allowed.end();
    };
    std::erase_if(names, foreign);
    return names;
}

std::string
page_address(const std::string& host, int port, const std::vector<std::string>& allowed, bool tls) {
    const bool every_address = host == "0.0.0.0" || host == "::";
    const std::string named = allowed.empty() ? "localhost" : allowed.front();
    const std::string name = every_address ? named : in_brackets(host);
    const std::string begin = (tls ? "https://" : "http://") + name;
    if (has_port(name) || port == usual_port(tls)) return begin + "/";
    return begin + ":" + std::to_string(port) + "/";
}

} // namespace axiscal
