// Sources: pty(7), termios(3); poll(2) of a pseudo terminal's near end says POLLHUP while nobody
// has its far end open, but not before that was open once.
#include "drivers/recording/near_wire.hpp"

#include "drivers/loop/deadline.hpp"
#include "drivers/wire/descriptor_link.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/use_awaitable.hpp>

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

namespace axiscal {
namespace {

using boost::asio::ip::tcp;

constexpr Duration between_looks = std::chrono::milliseconds{10}; // nothing tells of an opening
/// After open(2) the other side sets the line up and throws away what came before.
constexpr Duration set_up = std::chrono::milliseconds{100};

tl::unexpected<Error> failed(const std::string& what) {
    return fail(Fault::io, what, {errno, std::generic_category()});
}

class PtyWire final : public NearWire {
public:
    PtyWire(Scheduler& scheduler, std::string name)
        : scheduler_{scheduler}
        , name_{std::move(name)} {}
    ~PtyWire() override {
        close_all();
        std::error_code ignored; // a link that leads nowhere harms nobody
        if (!name_.empty()) std::filesystem::remove(name_, ignored);
    }
    PtyWire(const PtyWire&) = delete;
    PtyWire& operator=(const PtyWire&) = delete;

    [[nodiscard]] LinkSettings settings() const override {
        LinkSettings settings;
        settings.path = name_.empty() ? path_ : name_;
        return settings;
    }
    Task<Result<std::unique_ptr<ByteLink>>> accept(MonotonicTime deadline) override;
    Task<void> drain(MonotonicTime deadline) override;
    Result<void> unplug() override {
        close_all();
        return make();
    }
    Result<void> make();

private:
    void close_all() {
        if (master_ >= 0) ::close(master_);
        master_ = -1;
    }
    [[nodiscard]] bool is_open_there() const {
        pollfd look{master_, 0, 0};
        return ::poll(&look, 1, 0) >= 0 && (look.revents & POLLHUP) == 0;
    }
    Result<void> make_raw_once();
    [[nodiscard]] Result<void> name_it() const;

    Scheduler& scheduler_;
    std::string name_, path_;
    int master_ = -1;
};

Result<void> PtyWire::make() {
    master_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    std::array<char, 64> path{};
    if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0 ||
        ::ptsname_r(master_, path.data(), path.size()) != 0)
        return failed("cannot make a pseudo terminal");
    path_ = path.data();
    AXISCAL_CHECK(make_raw_once());
    return name_it();
}

/// Opened and closed here, so that POLLHUP tells from now on; the settings stay.
Result<void> PtyWire::make_raw_once() {
    const int far_end = ::open(path_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (far_end < 0) return failed("cannot open " + path_);
    termios line{};
    ::tcgetattr(far_end, &line);
    ::cfmakeraw(&line);
    ::tcsetattr(far_end, TCSANOW, &line);
    ::close(far_end);
    return {};
}

Result<void> PtyWire::name_it() const {
    if (name_.empty()) return {};
    std::error_code error;
    if (std::filesystem::is_symlink(name_, error)) std::filesystem::remove(name_, error);
    std::filesystem::create_symlink(path_, name_, error);
    if (error) return fail(Fault::io, "cannot make the link " + name_, error);
    return {};
}

Task<Result<std::unique_ptr<ByteLink>>> PtyWire::accept(MonotonicTime deadline) {
    while (!is_open_there()) {
        if (scheduler_.now() >= deadline)
            co_return fail(Fault::link_timeout, "nobody opens " + settings().path);
        co_await scheduler_.sleep_for(between_looks);
    }
    co_await scheduler_.sleep_for(set_up);
    const int copy = ::fcntl(master_, F_DUPFD_CLOEXEC, 0);
    if (copy < 0) co_return failed("cannot use " + path_);
    DescriptorKind kind;
    kind.name = "the far end of " + settings().path;
    co_return std::make_unique<DescriptorLink>(scheduler_, copy, std::move(kind));
}

/// The far end tells what waits there. Where its owner keeps it to himself (TIOCEXCL), a pause must
/// do.
Task<void> PtyWire::drain(MonotonicTime deadline) {
    co_await scheduler_.sleep_for(set_up); // the kernel carries bytes over behind our back
    const int far_end = ::open(path_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (far_end < 0) co_return;
    int waiting = 1;
    while (scheduler_.now() < deadline && ::ioctl(far_end, FIONREAD, &waiting) == 0 && waiting > 0)
        co_await scheduler_.sleep_for(between_looks);
    ::close(far_end);
}

class TcpWire final : public NearWire {
public:
    explicit TcpWire(Scheduler& scheduler)
        : scheduler_{scheduler}
        , door_{scheduler.executor()} {}

    Result<void> listen(int port) {
        boost::system::error_code error;
        const tcp::endpoint where{boost::asio::ip::address_v4::loopback(),
                                  static_cast<std::uint16_t>(port)};
        door_.open(where.protocol(), error);
        if (!error) door_.set_option(tcp::acceptor::reuse_address{true}, error);
        if (!error) door_.bind(where, error);
        if (!error) door_.listen(1, error);
        if (error) return fail(Fault::io, "cannot listen at port " + std::to_string(port), error);
        return {};
    }
    [[nodiscard]] LinkSettings settings() const override {
        LinkSettings settings;
        settings.kind = LinkSettings::Kind::tcp;
        settings.host = "127.0.0.1";
        settings.port = door_.local_endpoint().port();
        return settings;
    }
    Task<Result<std::unique_ptr<ByteLink>>> accept(MonotonicTime deadline) override {
        const auto caller = co_await before(scheduler_, next_caller(), deadline);
        if (!caller || *caller < 0)
            co_return fail(Fault::link_timeout, "nobody connects to " + settings().describe());
        DescriptorKind kind;
        kind.name = "the caller at " + settings().describe();
        kind.is_socket = true;
        co_return std::make_unique<DescriptorLink>(scheduler_, *caller, std::move(kind));
    }
    /// Closing a connection leaves what is on its way.
    Task<void> drain(MonotonicTime /*deadline*/) override { co_return; }
    Result<void> unplug() override { return {}; } // the connection is closed with its link

private:
    Task<int> next_caller() {
        auto [error, socket] =
            co_await door_.async_accept(boost::asio::as_tuple(boost::asio::use_awaitable));
        boost::system::error_code refused = error;
        if (!refused) socket.set_option(tcp::no_delay{true}, refused);
        if (!refused) socket.native_non_blocking(true, refused);
        co_return refused ? -1 : socket.release(refused);
    }
    Scheduler& scheduler_;
    tcp::acceptor door_;
};

} // namespace

Result<std::unique_ptr<NearWire>> make_pty_wire(Scheduler& scheduler, const std::string& name) {
    auto wire = std::make_unique<PtyWire>(scheduler, name);
    AXISCAL_CHECK(wire->make());
    return wire;
}

Result<std::unique_ptr<NearWire>> make_tcp_wire(Scheduler& scheduler, int port) {
    auto wire = std::make_unique<TcpWire>(scheduler);
    AXISCAL_CHECK(wire->listen(port));
    return wire;
}

} // namespace axiscal
