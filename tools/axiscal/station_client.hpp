#pragma once
// Talks to axiscald over its Unix socket, or over TCP with the token. Blocking; for the command
// line.

#include "analysis/quantity/result.hpp"

#include <chrono>
#include <optional>
#include <string>

namespace axiscal {

struct Reply {
    unsigned status = 0;
    std::string body;
};

struct DoorAddress {
    std::string socket_path; ///< used unless `host` is set
    std::string host;        ///< "127.0.0.1:8470", "[::1]:8470"
    std::string token;       ///< sent when not empty
    /// How long an answer is waited for; absent: as long as the station may take.
    std::optional<std::chrono::seconds> patience = std::nullopt;
};

class StationClient {
public:
    explicit StationClient(DoorAddress address)
        : address_{std::move(address)} {}
    /// Every address of a host is tried. @errors Fault::bad_request of an address that is none;
    /// Fault::io when nobody answers: the sentence says how to start the daemon, or, of a daemon
    /// that took the question, where to look.
    [[nodiscard]] Result<Reply> get(const std::string& target) const;
    [[nodiscard]] Result<Reply> post(const std::string& target, const std::string& body) const;

private:
    [[nodiscard]] Result<Reply>
    ask(const std::string& method, const std::string& target, const std::string& body) const;
    DoorAddress address_;
};

} // namespace axiscal
