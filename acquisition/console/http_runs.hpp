#pragma once
// Stored runs over HTTP: the list, one of them, and its papers. Files are read on a thread; the
// loop only hands on. Beast is heavy: of the daemon only the files http_*.cpp include this.

#include "acquisition/console/http_answer.hpp"
#include "acquisition/console/run_history.hpp"
#include "acquisition/live/station_interface.hpp"
#include "drivers/loop/scheduler.hpp"
#include "drivers/loop/work_thread.hpp"

#include <functional>
#include <memory>
#include <string>

namespace axiscal {

/// Held until an answer of megabytes is sent: there are few of them at a time.
using LargeAnswerSeat = std::shared_ptr<const void>;

/// Loop-bound; outlived by the station and the scheduler.
class RunsDoor {
public:
    RunsDoor(Scheduler& scheduler, StationInterface& station);
    /// @param state_directory  with runs/, outbox/ and published/. Until then every call answers
    /// 404.
    void show(std::string state_directory);
    /// Waits for the file that is being read. Before the loop ends: the thread speaks to it.
    void stop();

    /// GET /v1/runs.
    Task<HttpResponse> list(HttpRequest request);
    /// GET /v1/runs/ID. 503 while four large answers are under way.
    Task<HttpResponse> show_one(HttpRequest request, LargeAnswerSeat& seat);
    /// GET /v1/runs/ID/PAPER. 503 the same.
    Task<HttpResponse> give_paper(HttpRequest request, LargeAnswerSeat& seat);

private:
    template <class T> Task<Result<T>> read(std::function<Result<T>(RunHistory&)> job);
    std::shared_ptr<WorkThread> reader();
    [[nodiscard]] OpenRuns open_runs() const;
    [[nodiscard]] LargeAnswerSeat take_seat() const;

    Scheduler& scheduler_;
    StationInterface& station_;
    std::shared_ptr<RunHistory> history_; ///< touched on the thread alone; null: not shown
    std::shared_ptr<WorkThread> reader_;  ///< null until the first question
    std::shared_ptr<const int> seats_;    ///< its owners are the seats taken, and this
    bool stopped_ = false;
};

} // namespace axiscal
