#pragma once
// HTTP/JSON for people and the command line (docs/api.md). Reading is free on every door; what
// changes state needs the Unix socket or the bearer token. Loop-bound.

#include "acquisition/station/station_face.hpp"
#include "config/station_config.hpp"

#include <memory>
#include <string>

namespace axiscal {

class HttpFace {
public:
    HttpFace(Scheduler& scheduler, StationFace& station, ConsoleConfig config, std::string token);
    ~HttpFace();
    HttpFace(const HttpFace&) = delete;
    HttpFace& operator=(const HttpFace&) = delete;

    /// Whom console.allowed_clients does not name is hung up on at once. Each door has room for 64
    /// clients of its own.
    /// Binds both doors and starts serving. The socket gets mode 0660 and the configured group.
    /// @errors Fault::io naming the path or port and who may hold it.
    Result<void> start();
    /// The bound TCP port; 0: none. A configured -1 (tests) lets the kernel choose.
    [[nodiscard]] int port() const;

private:
    struct Impl;
    std::shared_ptr<Impl> impl_;
};

} // namespace axiscal
