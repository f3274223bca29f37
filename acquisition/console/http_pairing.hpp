#pragma once
// Pairing over HTTP: who is behind a cookie, and the answers about codes and sessions. Rights were
// judged before (access.hpp). Loop-bound; lives longer than its answers take.

#include "acquisition/console/http_answer.hpp"
#include "acquisition/console/pairing.hpp"
#include "config/station_config.hpp"
#include "drivers/loop/scheduler.hpp"
#include "drivers/loop/work_thread.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace axiscal {

class PairingDoor {
public:
    /// @param file  of the paired browsers; empty: the end of the daemon ends each pairing. A file
    /// that cannot be read is told in the log, and nobody is paired.
    PairingDoor(Scheduler& scheduler, std::string file);
    /// Waits for what is being written. Before the loop ends: the writer speaks to it.
    void stop();

    /// What the browser of these cookies is called; empty: it is not paired.
    [[nodiscard]] std::string name_of(std::string_view cookies) const;
    /// It has ordered something.
    void note_order(std::string_view cookies);

    /// POST /v1/pair. @param no_way  why no browser gets in now; empty: `config` says where
    HttpResponse
    offer(const HttpRequest& request, const ConsoleConfig& config, const std::string& no_way);
    /// GET /v1/pair.
    [[nodiscard]] HttpResponse list(const HttpRequest& request) const;
    /// POST /v1/pair/end. 500 where a restart of the daemon would undo it.
    Task<HttpResponse> end(HttpRequest request);

    /// GET /v1/session.
    [[nodiscard]] HttpResponse show_session(const HttpRequest& request) const;
    /// POST /v1/session. @param secure  the door speaks TLS
    Task<HttpResponse> open_session(HttpRequest request, bool secure);
    /// DELETE /v1/session.
    Task<HttpResponse> close_session(HttpRequest request, bool secure);

private:
    [[nodiscard]] PairingTime now() const;
    /// On disk, behind what was saved before.
    Task<Result<void>> save();
    Task<void> save_or_tell();

    Scheduler& scheduler_;
    std::string file_;
    PairingDesk desk_;
    /// Of the file: the disk may be slow, and the loop waits for nobody. Null until the first time.
    std::shared_ptr<WorkThread> writer_;
    bool stopped_ = false;
};

} // namespace axiscal
