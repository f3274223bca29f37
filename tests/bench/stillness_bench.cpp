// A second of a laser at 50 kHz while the station waits for the axis to stand: every sample pushed,
// a look for a still window each 20 ms. Held against one pass over the second's samples. The axis
// creeps and never stands, so each look is a look at a search that has gone on for nine seconds.
#include "acquisition/capture/stillness.hpp"
#include "tests/bench/row.hpp"

#include <random>

namespace axiscal::bench {
namespace {

constexpr int samples_a_second = 50'000, looks_a_second = 50;
constexpr Duration sample_period = std::chrono::microseconds{20};
constexpr Duration between_looks = std::chrono::milliseconds{20};
constexpr int seconds_before = 9;

class Waiting {
public:
    Waiting() {
        config_.spread_limit = 3.0_um;
        for (int i = 0; i < seconds_before; ++i)
            second();
    }
    void second() {
        for (int look = 0; look < looks_a_second; ++look) {
            for (int i = 0; i < samples_a_second / looks_a_second; ++i)
                push();
            if (search_.look(history_, now_).window) std::abort();
        }
        // The history forgets; what is searched stays nine seconds long.
        if (now_ - from_ > std::chrono::seconds{seconds_before + 1}) begin_anew();
    }
    [[nodiscard]] double one_pass() const {
        const auto all = history_.all();
        double sum = 0;
        for (const Sample& sample : all.last(samples_a_second))
            sum += sample.value().value_or(0);
        return sum;
    }

private:
    void push() {
        now_ += sample_period;
        place_m_ += 1e-9; // 50 um/s
        history_.push(
            {0, now_, place_m_ + static_cast<double>(noise_() % 100) * 1e-9, ++number_, 1});
    }
    void begin_anew() {
        from_ = now_ - std::chrono::seconds{seconds_before};
        search_ = StillWindowSearch{from_, config_};
        if (search_.look(history_, now_).window) std::abort();
    }

    CaptureConfig config_;
    SampleHistory history_;
    MonotonicTime now_ = monotonic_from_ns(1'000'000'000), from_ = now_;
    StillWindowSearch search_{from_, config_};
    std::minstd_rand noise_{1};
    std::uint64_t number_ = 0;
    double place_m_ = 0;
};

Waiting& waiting() {
    static Waiting one;
    return one;
}

[[maybe_unused]] const bool added =
    add(Row{"waiting for the axis to stand, a second of 50 kHz", [] { waiting().second(); },
            [] { benchmark::DoNotOptimize(waiting().one_pass()); }, 0, 10, "read pass"});

} // namespace
} // namespace axiscal::bench
