#include "acquisition/console/access.hpp"

#include <algorithm>

namespace axiscal {
namespace {

/// Takes as long for a wrong first letter as for a wrong last one.
bool same_secret(std::string_view given, std::string_view wanted) {
    unsigned difference = given.size() == wanted.size() ? 0U : 1U;
    for (std::size_t i = 0; i < given.size(); ++i)
        difference |= static_cast<unsigned>(
            static_cast<unsigned char>(given[i]) ^
            static_cast<unsigned char>(wanted[i % std::max<std::size_t>(wanted.size(), 1)]));
    return difference == 0 && !wanted.empty();
}

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
    const std::size_t port = name.find(':', name.find(']') == std::string::npos ? 0 : name.find(']'));
    const std::size_t end = std::min(port, name.size());
    if (end > 0 && name[end - 1] == '.') name.erase(end - 1, 1);
    return name;
}

bool is_known(std::string_view host, const AccessRules& rules) {
    const std::string asked = comparable(host);
    const auto same = [&](const std::string& known) { return comparable(known) == asked; };
    return std::ranges::any_of(rules.known_hosts, same);
}

bool own_origin(const std::string& origin, const AccessRules& rules) {
    const std::string small = in_small(origin);
    for (const std::string_view scheme : {"http://", "https://"})
        if (small.starts_with(scheme))
            return is_known(std::string_view{small}.substr(scheme.size()), rules);
    return false;
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

} // namespace

AccessVerdict judge_access(const RequestHead& head, const AccessRules& rules) {
    if (head.door == Door::tcp && !is_known(head.host, rules))
        return {421, "Host '" + head.host +
                         "' is not a name of this station; add it to console.allowed_hosts"};
    if (!head.origin.empty() && !own_origin(head.origin, rules))
        return {403, "Origin '" + head.origin +
                         "' is foreign; pages of other sites may not talk to the station"};
    if (!head.changes_state || head.door == Door::unix_socket) return {};
    if (same_secret(bearer_of(head.authorization), rules.token)) return {};
    return {401, "Over TCP everybody only reads. Use the Unix socket (group axiscal) or the token "
                 "in the state directory"};
}

std::vector<std::string>
known_hosts_of(const std::string& host, int port, const std::vector<std::string>& allowed) {
    std::vector<std::string> names{"localhost", "127.0.0.1", "[::1]"};
    names.push_back(host.find(':') == std::string::npos ? host : "[" + host + "]");
    names.insert(names.end(), allowed.begin(), allowed.end());
    const std::size_t bare = names.size();
    for (std::size_t i = 0; i < bare; ++i)
        names.push_back(names[i] + ":" + std::to_string(port));
    return names;
}

} // namespace axiscal
