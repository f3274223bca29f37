#pragma once
// A link over any pollable descriptor: tty, pty or socket. Loop-bound.

#include "drivers/wire/byte_link.hpp"
#include "drivers/wire/deadline_watch.hpp"
#include "drivers/wire/parity_marks.hpp"

#include <boost/asio/posix/stream_descriptor.hpp>

#include <functional>

namespace axiscal {

struct DescriptorKind {
    std::string name; ///< for messages: "serial /dev/ttyACM0 115200 8N1"
    bool is_socket = false;
    bool parity_is_marked = false; ///< a tty with PARMRK
    Duration latency_uncertainty{};
    std::string remark;
    std::function<void(int)> close; ///< who closes it, where close(2) can block; empty: the link
};

/// Owns a non-blocking descriptor. Every read waits for readiness first, so that a flooding
/// instrument takes its turn on the loop like any other.
class DescriptorLink final : public ByteLink {
public:
    DescriptorLink(Scheduler& scheduler, int descriptor, DescriptorKind kind);
    ~DescriptorLink() override;
    DescriptorLink(const DescriptorLink&) = delete;
    DescriptorLink& operator=(const DescriptorLink&) = delete;

    Task<Result<TimedBytes>> read_some(MonotonicTime deadline) override;
    Task<Result<void>> write_all(std::vector<std::byte> bytes, MonotonicTime deadline) override;
    [[nodiscard]] Duration latency_uncertainty() const override {
        return kind_.latency_uncertainty;
    }
    [[nodiscard]] std::string remark() const override { return kind_.remark; }

private:
    using WaitType = boost::asio::posix::descriptor_base::wait_type;
    Task<boost::system::error_code> readiness(WaitType what);
    Task<Result<void>> writable(MonotonicTime deadline);
    [[nodiscard]] tl::unexpected<Error> silent() const;
    [[nodiscard]] tl::unexpected<Error> closed(int error_number) const;

    Scheduler& scheduler_;
    DescriptorKind kind_;
    std::vector<std::byte> buffer_;
    boost::asio::posix::stream_descriptor descriptor_;
    DeadlineWatch reading_;
    ParityMarks marks_;
};

} // namespace axiscal
