#pragma once
// Opens the two doors of the console. Private to it.

#include "analysis/quantity/result.hpp"
#include "config/station_config.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>

namespace axiscal {

/// The Unix socket, mode 0660 from the first moment, given to the configured group; without a path
/// nothing. @errors Fault::io naming path or group; then no socket is left.
Result<void> listen(boost::asio::local::stream_protocol::acceptor& local,
                    const ConsoleConfig& config);

/// Port 0: nothing; -1 (tests): the kernel chooses, and config.port tells.
/// @errors Fault::bad_configuration for the host, Fault::io naming the port and who may hold it.
Result<void> listen(boost::asio::ip::tcp::acceptor& tcp, ConsoleConfig& config);

} // namespace axiscal
