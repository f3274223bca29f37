#pragma once
// The tests that the station shows: the one before a CNC, and the one at rest; each is open or was
// the last one. Loop-bound.

#include "acquisition/measurement/measurement.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

namespace axiscal {

class LatestTests {
public:
    /// The stored one that was opened latest.
    struct Newest {
        std::string run_id; ///< empty: none
        std::int64_t opened_utc_ns = 0;
    };

    /// It takes the place of the last one before the CNC, and is the newest.
    void put_on(std::shared_ptr<Measurement> test, std::int64_t opened_utc_ns) {
        newest_ = Newest{test->run().run_id, opened_utc_ns};
        run_ = std::move(test);
    }
    /// A closed one of an earlier daemon, which is the newest already.
    void put_on_closed(std::shared_ptr<Measurement> test) { run_ = std::move(test); }
    /// It takes the place of the last one at rest.
    void let_rest(std::shared_ptr<Measurement> test) { resting_ = std::move(test); }
    void keep_newest(Newest newest) { newest_ = std::move(newest); }

    /// Null before the first. A test of the drift does not end it.
    [[nodiscard]] const std::shared_ptr<Measurement>& run() const { return run_; }
    [[nodiscard]] const std::shared_ptr<Measurement>& resting() const { return resting_; }
    [[nodiscard]] const Newest& newest() const { return newest_; }
    /// What this daemon measures, or took over, lies there.
    [[nodiscard]] bool lies_at(const std::string& path) const {
        return (run_ && run_->run().path == path) || (resting_ && resting_->run().path == path);
    }

    // Of the one before the CNC.
    [[nodiscard]] bool run_open() const { return run_ && run_->is_open(); }
    /// Neither closing nor closed.
    [[nodiscard]] bool takes_records() const {
        return run_ && run_->run().stage == RunState::Stage::open;
    }
    [[nodiscard]] bool is_being_closed() const {
        return run_ && run_->run().stage == RunState::Stage::closing;
    }
    /// Its closing row is not on disk.
    [[nodiscard]] bool is_unwritten() const { return run_ && !run_->is_written(); }

    [[nodiscard]] bool rest_goes_on() const { return resting_ && resting_->is_open(); }
    /// Of the one that is open, before the CNC or at rest; empty: none.
    [[nodiscard]] std::string open_id() const {
        if (run_open()) return run_->run().run_id;
        return rest_goes_on() ? resting_->run().run_id : std::string{};
    }

private:
    std::shared_ptr<Measurement> run_, resting_;
    Newest newest_;
};

} // namespace axiscal
