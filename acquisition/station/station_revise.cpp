// A person adds to a run: points taken again, readings left out, answers to findings; also after it
// was closed.
#include "acquisition/station/station.hpp"

#include "acquisition/measurement/held.hpp"

#include <utility>

namespace axiscal {

Result<std::shared_ptr<Revisable>> Station::run_that_may_be_revised() const {
    if (!last_run()) return fail(Fault::no_run_armed, "there is no run to add to");
    AXISCAL_TRY(std::shared_ptr<Revisable> run, last_run()->to_be_added_to());
    if (disk_.goes_on())
        return fail(Fault::not_durable, "the disk cannot store the records of the run yet; "
                                        "'axiscal status' shows why");
    AXISCAL_CHECK(run->order_is_known());
    if (under_way_.arming || under_way_.revising)
        return fail(Fault::busy, "somebody else is at it just now");
    if (drift_open()) return fail(Fault::busy, "a drift test is going on; let it end");
    if (tests_.is_being_closed()) return fail(Fault::busy, "the run is being closed; ask again");
    return run;
}

/// Where no run is known, the newest of an earlier daemon.
Task<Result<std::shared_ptr<Revisable>>> Station::run_to_revise() {
    if (auto taken = co_await recovery_.take_over_closed_run(); !taken)
        co_return tl::unexpected<Error>(taken.error());
    co_return run_that_may_be_revised();
}

/// Also of a closed run, under which nobody else waits for the disk.
void Station::find_out_about_order(const Revisable& test) {
    if (test.order_is_lost()) disk_.begin();
}

Task<Result<RetakeAnswer>> Station::retake(RevisionRequest request) {
    AXISCAL_CO_TRY(const std::shared_ptr<Revisable> test, co_await run_to_revise());
    const Held revising{under_way_.revising};
    auto taken = co_await test->retake(std::move(request));
    find_out_about_order(*test);
    co_return taken;
}

Task<Result<int>> Station::exclude(RevisionRequest request) {
    AXISCAL_CO_TRY(const std::shared_ptr<Revisable> test, co_await run_to_revise());
    const Held revising{under_way_.revising};
    auto left_out = co_await test->exclude(std::move(request));
    find_out_about_order(*test);
    co_return left_out;
}

Task<Result<void>> Station::answer_finding(AnswerRequest request) {
    AXISCAL_CO_TRY(const std::shared_ptr<Revisable> test, co_await run_to_revise());
    if (run_open())
        co_return fail(Fault::busy,
                       "the run is open; its set-up is searched when it has its certificate");
    const Held revising{under_way_.revising};
    auto kept = co_await test->answer_finding(std::move(request));
    find_out_about_order(*test);
    co_return kept;
}

} // namespace axiscal
