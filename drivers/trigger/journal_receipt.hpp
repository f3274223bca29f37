#pragma once
#include <cstdint>

namespace axiscal {

/// Proof that something is on disk. Only the Journal can make one, after a durable commit, and
/// only with one can a trigger port publish `done`.
class JournalReceipt {
public:
    [[nodiscard]] std::uint16_t sequence() const { return sequence_; }
    [[nodiscard]] int step() const { return step_; }

private:
    friend class Journal;
    JournalReceipt(std::uint16_t sequence, int step)
        : step_{step}
        , sequence_{sequence} {}
    int step_;
    std::uint16_t sequence_;
};

} // namespace axiscal
