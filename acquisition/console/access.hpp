#pragma once
// Who may do what at the HTTP doors. Pure, so that each rule has its test.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

enum class Door : std::uint8_t { unix_socket, tcp };

struct RequestHead {
    Door door = Door::tcp;
    bool changes_state = false;
    std::string host, origin, authorization;
};

struct AccessRules {
    std::vector<std::string> known_hosts; ///< "localhost", "127.0.0.1", ... with or without port
    std::string token;
};

/// HTTP status: 200 may pass; 401 no or wrong token; 403 foreign Origin; 421 unknown Host.
struct AccessVerdict {
    unsigned status = 200;
    std::string sentence;
};
AccessVerdict judge_access(const RequestHead& head, const AccessRules& rules);

/// Every name under which the daemon answers on `host`:`port`.
std::vector<std::string>
known_hosts_of(const std::string& host, int port, const std::vector<std::string>& allowed);

} // namespace axiscal
