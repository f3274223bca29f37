#pragma once
// Who may do what at the HTTP doors. Pure, so that each rule has its test.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

enum class Door : std::uint8_t { unix_socket, tcp };

inline constexpr std::string_view session_path = "/v1/session";   ///< of a browser's own pairing
inline constexpr std::string_view pair_path = "/v1/pair";         ///< codes, and who is paired
inline constexpr std::string_view pair_end_path = "/v1/pair/end"; ///< of others' pairings

/// What a request is about, as far as rights differ.
enum class Matter : std::uint8_t {
    station,
    opening_session, ///< a browser bears the code that was shown at the station
    pairing,         ///< for who sits at the station alone
};

struct RequestHead {
    Door door = Door::tcp;
    bool changes_state = false;
    Matter matter = Matter::station;
    std::string host, origin, authorization;
    std::string cookies = {}; ///< as they came
    std::string page = {};    ///< name of the paired browser that they prove; empty: none
};

struct AccessRules {
    std::vector<std::string> known_hosts; ///< "localhost", "127.0.0.1", ... with or without port
    std::string token;
    std::vector<std::string> page_hosts = {}; ///< whose pages may order by a cookie
    bool tls = false; ///< a page that came without TLS may be anybody's, and is foreign
};

/// HTTP status: 200 may pass; 401 no or wrong token; 403 foreign Origin; 421 unknown Host.
struct AccessVerdict {
    unsigned status = 200;
    std::string sentence = {};
    bool by_page = false; ///< it passes as an order of a paired browser, by nothing else
};
AccessVerdict judge_access(const RequestHead& head, const AccessRules& rules);

/// Takes as long for a wrong first letter as for a wrong last one. Nothing is the same as an empty
/// secret.
bool same_secret(std::string_view given, std::string_view wanted);

/// Every name under which the daemon answers on `host`:`port`.
std::vector<std::string>
known_hosts_of(const std::string& host, int port, const std::vector<std::string>& allowed);
/// Hosts whose pages are the station's own: names with its port, and the allowed ones also as they
/// are written. A cookie does not tell ports apart: another program's page at port 80 of this
/// computer is a stranger. @param tls  the usual port is 443, not 80
std::vector<std::string> page_hosts_of(const std::string& host,
                                       int port,
                                       const std::vector<std::string>& allowed,
                                       bool tls = false);
/// Where a browser finds the station, "http://127.0.0.1:8470/", "https://bay3.plant.example/".
std::string page_address(const std::string& host,
                         int port,
                         const std::vector<std::string>& allowed,
                         bool tls = false);

} // namespace axiscal
