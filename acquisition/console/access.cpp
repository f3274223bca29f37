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

bool is_known(const std::string& host, const AccessRules& rules) {
    return std::ranges::find(rules.known_hosts, host) != rules.known_hosts.end();
}

bool own_origin(const std::string& origin, const AccessRules& rules) {
    for (const char* scheme : {"http://", "https://"})
        if (origin.starts_with(scheme))
            return is_known(origin.substr(std::string_view{scheme}.size()), rules);
    return false;
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
    constexpr std::string_view scheme = "Bearer ";
    if (head.authorization.starts_with(scheme) &&
        same_secret(std::string_view{head.authorization}.substr(scheme.size()), rules.token))
        return {};
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
