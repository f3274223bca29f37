#pragma once
// The TCP door where a certificate is named: between it and the requests stands axiscald-tls.so, on
// a thread of its own. Private to the console. Loop-bound.

#include "acquisition/tls/tls_interface.hpp"
#include "analysis/quantity/result.hpp"
#include "config/station_config.hpp"
#include "drivers/loop/scheduler.hpp"
#include "drivers/loop/work_thread.hpp"
#include "drivers/turned_away.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>

#include <memory>

namespace axiscal {

class TlsEntrance : public std::enable_shared_from_this<TlsEntrance> {
public:
    using Plain = boost::asio::local::stream_protocol::socket;

    /// Loads the module. @errors Fault::io for the module, Fault::bad_configuration for the files
    static Result<std::shared_ptr<TlsEntrance>> open(Scheduler& scheduler,
                                                     const ConsoleConfig& config);
    explicit TlsEntrance(Scheduler& scheduler);
    /// Hangs up on everybody, and waits for the thread. Before the loop ends.
    ~TlsEntrance();
    TlsEntrance(const TlsEntrance&) = delete;
    TlsEntrance& operator=(const TlsEntrance&) = delete;

    /// @returns where the client is read and answered in clear. It ends where the handshake comes
    /// to nothing. @errors Fault::io: out of descriptors; the client is hung up on.
    Result<Plain> take(boost::asio::ip::tcp::socket client);

private:
    void tell(const TlsTold& told);

    Scheduler& scheduler_;
    std::unique_ptr<TlsDoor> door_;
    TurnedAway strangers_; ///< to TLS: scanners, browsers that do not know the certificate
    std::unique_ptr<WorkThread> thread_;
};

} // namespace axiscal
