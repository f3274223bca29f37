#pragma once
// Whether the set-up of a closed run still stands, so that points may be taken again: the counter
// keeps its zero, the beam is not interrupted, the reading does not jump. Pure.

#include "analysis/quantity/quantity.hpp"
#include "drivers/sample.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace axiscal {

class SetUpWatch {
public:
    /// What a reading is held against.
    struct Run {
        bool known = false;        ///< a run was closed; else what is seen counts since the start
        std::uint32_t epoch = 0;   ///< of the counter, under which its datum holds
        bool of_this_start = true; ///< closed by this daemon
        Speed fastest;             ///< that the axis can move; 0: jumps are not judged
    };

    /// @param reference  "laser" | "scale", for sentences
    explicit SetUpWatch(std::string reference)
        : reference_{std::move(reference)} {}

    void take(const Sample& sample, const Run& run);
    /// A run was closed: what is lost from now on is lost since then.
    void begin();
    /// For a reason that no reading shows. The first reason stays.
    void lose(std::string why);

    /// Why nothing can be taken again; empty: nothing speaks against it.
    [[nodiscard]] const std::string& lost() const { return lost_; }
    /// Of the counter at the start; 0 before its first sample.
    [[nodiscard]] std::uint32_t first_epoch() const { return first_ ? first_->epoch : 0; }
    /// The first good one that is no older byte out of a USB buffer; while no run is known.
    [[nodiscard]] const std::optional<Sample>& settled() const { return settled_; }

private:
    std::string reference_;
    std::string lost_;
    std::optional<Sample> last_;            ///< good one since begin(), or since the start
    std::optional<Sample> first_, settled_; ///< since the start
};

} // namespace axiscal
