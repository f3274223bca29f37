// Proves that the lane can fail. `data_race forgotten`: a thread leaves its result in a variable
// that the main thread reads without being told; the sanitizer must report it and end with 66.
// `data_race fenced`: the same result by the product's own fence; nothing may be reported.

#include "drivers/loop/asio_scheduler.hpp"
#include "drivers/loop/work_thread.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>

#include <cstdio>
#include <string_view>

using namespace axiscal;

namespace {

int leave_it_lying() {
    int reply = 0;
    std::thread line{[&reply] { reply = 42; }};
    const int seen = reply; // nobody posted it
    line.join();
    return seen;
}

Task<void> keep(std::shared_ptr<WorkThread> thread, Scheduler& scheduler, int& reply) {
    std::function<Result<int>()> job = [] { return Result<int>{42}; };
    const auto deadline = scheduler.now() + std::chrono::seconds{10};
    const auto answer =
        co_await on_thread<int>(std::move(thread), scheduler, std::move(job), deadline);
    reply = answer.value_or(-1);
}

int hand_it_over() {
    boost::asio::io_context loop;
    AsioScheduler scheduler{loop};
    WorkThreads threads;
    int reply = 0;
    auto thread = threads.start("line").value();
    boost::asio::co_spawn(loop, keep(std::move(thread), scheduler, reply), boost::asio::detached);
    loop.run();
    return reply;
}

} // namespace

int main(int count, char** arguments) {
    const std::string_view how = count == 2 ? arguments[1] : "";
    if (how != "forgotten" && how != "fenced") return 2;
    const int reply = how == "forgotten" ? leave_it_lying() : hand_it_over();
    std::printf("%d\n", reply);
    return how == "fenced" && reply != 42 ? 1 : 0;
}
