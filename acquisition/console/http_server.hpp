#pragma once
// HTTP/JSON for people and the command line (docs/api.md). Reading is free on every door; what
// changes state needs the Unix socket, the bearer token or a paired browser. Loop-bound.

#include "acquisition/console/page_files.hpp"
#include "acquisition/live/station_interface.hpp"
#include "config/station_config.hpp"

#include <memory>
#include <string>

namespace axiscal {

class HttpServer {
public:
    /// @param paired_file  keeps who is paired (docs/pairing.md); empty: nothing does
    HttpServer(Scheduler& scheduler,
               StationInterface& station,
               ConsoleConfig config,
               std::string token,
               std::string paired_file = {});
    ~HttpServer();
    HttpServer(const HttpServer&) = delete;
    HttpServer& operator=(const HttpServer&) = delete;

    /// Takes the path of the Unix socket, which says that no other daemon answers there; who
    /// connects waits for start(). The socket gets mode 0660 and the configured group.
    /// @errors those of listen(), naming the path.
    Result<void> bind();
    /// What GET / and GET /page/... show (docs/page.md); until then they answer 404. Before
    /// start().
    void show_page(PageFiles page);
    /// Where GET /v1/runs finds runs/, outbox/ and published/; until then it answers 404. Before
    /// start().
    void show_runs(std::string state_directory);
    /// Whom console.allowed_clients does not name is hung up on at once. Each door has room for 64
    /// clients of its own.
    /// bind(), unless done, and serves both doors. A TCP address that cannot be had yet is told and
    /// tried again each second. @errors those of bind(); Fault::bad_configuration for the host.
    Result<void> start();
    /// Hangs up on who listens to GET /v1/events, and takes nobody more: the daemon is about to
    /// end.
    void end_events();
    /// The bound TCP port; 0: none. A configured -1 (tests) lets the kernel choose.
    [[nodiscard]] int port() const;

private:
    struct Impl;
    std::shared_ptr<Impl> impl_;
};

} // namespace axiscal
