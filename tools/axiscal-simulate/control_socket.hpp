#pragma once
// The control channel: a Unix socket, one command a line, one JSON object a line back.

#include "analysis/quantity/result.hpp"

#include <functional>
#include <stop_token>
#include <string>

namespace axiscal::simulate {

/// Loop-bound to the thread that calls serve(); one client at a time is enough.
class ControlSocket {
public:
    using Obey = std::function<std::string(const std::string& line)>;
    /// @errors io; refused where the path is no socket.
    static Result<ControlSocket> listen(const std::string& path);
    ControlSocket(ControlSocket&& other) noexcept;
    ControlSocket& operator=(ControlSocket&&) = delete;
    ~ControlSocket();
    ControlSocket(const ControlSocket&) = delete;
    ControlSocket& operator=(const ControlSocket&) = delete;
    /// Answers clients until stopped (looks every 50 ms).
    void serve(const std::stop_token& stop, const Obey& obey) const;

private:
    ControlSocket(int listener, std::string path)
        : listener_{listener}
        , path_{std::move(path)} {}
    int listener_;
    std::string path_;
};

} // namespace axiscal::simulate
