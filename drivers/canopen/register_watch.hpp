#pragma once
// The error register of a node (object 0x1001, CiA 301 V4.2, 7.5.2.2), asked for after each
// emergency message: the message tells it as it was at that moment. Pure.

#include "analysis/quantity/time.hpp"
#include "drivers/canopen/sdo.hpp"

#include <optional>

namespace axiscal {

inline constexpr ObjectKey error_register_key{0x1001, 0};

class RegisterWatch {
public:
    explicit RegisterWatch(int node)
        : node_{node} {}
    void after_emergency() { due_ = true; }
    /// What is to be sent now, if anything is.
    std::optional<CanFrame> question(MonotonicTime now);
    /// The register as it is since the last emergency. An answer to a question before that may be
    /// older, and a node that refuses has none to tell.
    std::optional<unsigned> take(const CanFrame& frame);

private:
    int node_;
    bool due_ = false;                 ///< an emergency came since it was asked for
    std::optional<SdoTransfer> asked_; ///< not yet answered
    MonotonicTime asked_at_{};
};

} // namespace axiscal
