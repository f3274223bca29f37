#pragma once
// A real opener that counts its answers: a test writes when the link is open, not before.

#include "drivers/wire/link_opener.hpp"

namespace axiscal::testing {

class WatchedOpener final : public LinkOpener {
public:
    explicit WatchedOpener(Scheduler& scheduler)
        : real_{scheduler} {}
    Task<Result<std::unique_ptr<ByteLink>>> open(const LinkSettings& settings,
                                                 MonotonicTime deadline) override {
        auto opened = co_await real_.open(settings, deadline);
        ++answers_;
        co_return opened;
    }
    [[nodiscard]] ModbusBuses* modbus_buses() override { return real_.modbus_buses(); }
    /// How many openings have succeeded or failed.
    [[nodiscard]] int answers() const { return answers_; }

private:
    RealLinkOpener real_;
    int answers_ = 0;
};

} // namespace axiscal::testing
