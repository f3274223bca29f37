#pragma once
// Talks to axiscald over its Unix socket, or over TCP with the token. Blocking; for the command
// line.

#include "analysis/quantity/result.hpp"

#include <string>

namespace axiscal {

struct Reply {
    unsigned status = 0;
    std::string body;
};

struct DoorAddress {
    std::string socket_path; ///< used unless `host` is set
    std::string host;        ///< "127.0.0.1:8470"
    std::string token;       ///< sent when not empty
};

class StationClient {
public:
    explicit StationClient(DoorAddress address)
        : address_{std::move(address)} {}
    /// @errors Fault::io when nobody answers; the sentence says how to start the daemon.
    [[nodiscard]] Result<Reply> get(const std::string& target) const;
    [[nodiscard]] Result<Reply> post(const std::string& target, const std::string& body) const;

private:
    [[nodiscard]] Result<Reply>
    ask(const std::string& method, const std::string& target, const std::string& body) const;
    DoorAddress address_;
};

} // namespace axiscal
