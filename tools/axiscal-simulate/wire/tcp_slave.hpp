#pragma once
// A listening Modbus TCP slave on a thread: frames in, answers out, any number of clients.

#include "analysis/quantity/result.hpp"
#include "wire/modbus_slave.hpp"

#include <functional>
#include <map>
#include <memory>
#include <stop_token>
#include <string>

namespace axiscal::simulate {

class TcpSlave {
public:
    /// The answer to (unit, pdu); empty: silence.
    using Answer = std::function<Bytes(int unit, std::span<const std::uint8_t> pdu)>;
    /// Listens on 127.0.0.1; port 0 chooses. @errors io: the port is taken.
    static Result<std::unique_ptr<TcpSlave>> listen(int port, Answer answer);
    ~TcpSlave();
    TcpSlave(const TcpSlave&) = delete;
    TcpSlave& operator=(const TcpSlave&) = delete;

    /// Serves until stopped; calls idle about every 20 ms.
    void run(const std::stop_token& stop, const std::function<void()>& idle = {});
    [[nodiscard]] int port() const { return port_; }

private:
    TcpSlave(int listener, int port, Answer answer);
    bool serve(int socket, Bytes& pending);
    void accept_one();
    void close_client(int socket);

    int listener_, port_;
    Answer answer_;
    std::map<int, Bytes> clients_; ///< socket -> bytes not yet a frame
};

} // namespace axiscal::simulate
