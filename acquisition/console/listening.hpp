#pragma once
// Opens the two doors of the console. Private to it.

#include "analysis/quantity/result.hpp"
#include "config/station_config.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>

#include <string>
#include <sys/types.h>

namespace axiscal {

/// The file of a bound socket. The end takes it away, unless another one has its name by now.
class SocketFile {
public:
    SocketFile() = default;
    explicit SocketFile(std::string path);
    SocketFile(SocketFile&& other) noexcept;
    SocketFile& operator=(SocketFile&& other) noexcept;
    ~SocketFile();

private:
    std::string path_; ///< empty: none
    dev_t device_ = 0;
    ino_t inode_ = 0;
};

/// The Unix socket, mode 0660 from the first moment, given to the configured group; without a path
/// nothing. What an ended daemon left there is replaced. @errors Fault::busy where somebody answers
/// there, Fault::refused where the path is that of another file; Fault::io naming path or group.
/// Then no socket of ours is left.
Result<SocketFile> listen(boost::asio::local::stream_protocol::acceptor& local,
                          const ConsoleConfig& config);

/// Port 0: nothing; -1 (tests): the kernel chooses, and config.port tells.
/// @errors Fault::bad_configuration for the host, Fault::io naming the port and who may hold it.
Result<void> listen(boost::asio::ip::tcp::acceptor& tcp, ConsoleConfig& config);

} // namespace axiscal
