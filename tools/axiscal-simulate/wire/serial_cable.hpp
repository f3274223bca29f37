#pragma once
// Two pseudo terminals joined: the serial line between a station's port and a CNC's.

#include "wire/pty.hpp"

#include <memory>
#include <stop_token>
#include <string>

namespace axiscal::simulate {

class SerialCable {
public:
    /// Both names are symlinks to the two ends. @errors as Pty::open.
    static Result<std::unique_ptr<SerialCable>> open(const std::string& a, const std::string& b);
    /// Carries bytes both ways until stopped.
    void run(const std::stop_token& stop);

private:
    SerialCable(Pty a, Pty b)
        : a_{std::move(a)}
        , b_{std::move(b)} {}
    Pty a_, b_;
};

} // namespace axiscal::simulate
