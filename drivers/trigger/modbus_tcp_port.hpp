#pragma once
// The CNC is the Modbus TCP client, we are the server. Asio reads frames and writes answers, so a
// slow, split, broken or never-reading client holds up nobody but itself. Loop-bound.

#include "drivers/trigger/trigger_server.hpp"
#include "drivers/turned_away.hpp"

#include <boost/asio/ip/tcp.hpp>

namespace axiscal {

/// How long one waits for a client before hanging up.
struct ClientPatience {
    Duration frame = std::chrono::seconds{2};  ///< from the first byte of a frame to its last
    Duration answer = std::chrono::seconds{2}; ///< for the client to take an answer
    Duration idle = std::chrono::minutes{10};  ///< between frames; a dwell of the CNC is shorter
};

class ModbusTcpPort final : public MappedPort {
public:
    ModbusTcpPort(std::unique_ptr<RegisterMap> map, TriggerConfig config, ClientPatience patience);
    /// @errors Fault::io when the address cannot be listened on. Any unit identifier is answered.
    Task<Result<void>> run(TriggerContext context) override;
    [[nodiscard]] std::string describe() const override;
    /// The port in use, also when the configuration says 0; 0 while not listening.
    [[nodiscard]] int bound_port() const { return bound_port_; }
    [[nodiscard]] int clients() const { return *open_clients_; }

private:
    struct Client;
    using Acceptor = boost::asio::ip::tcp::acceptor;
    [[nodiscard]] Result<Acceptor> listen(const TriggerContext& context) const;
    Task<void> accept_clients(Acceptor& acceptor, Scheduler* scheduler);
    [[nodiscard]] bool is_stranger(const boost::asio::ip::tcp::socket& socket, MonotonicTime now);
    void make_room(const boost::asio::ip::address& newcomer);
    void admit(boost::asio::ip::tcp::socket socket, Scheduler* scheduler);
    static Task<void> attend(std::shared_ptr<Client> client);
    static Task<void> serve(Client& client);
    static Task<bool> answer_frames(Client& client);
    static Task<void> watch(Client& client);
    void hang_up_all();

    ClientPatience patience_;
    std::vector<std::weak_ptr<Client>> clients_;
    std::shared_ptr<int> open_clients_ = std::make_shared<int>(0); ///< shared with the clients
    int bound_port_ = 0;
    TurnedAway strangers_;
};

} // namespace axiscal
