#pragma once
// Samples side by side in memory, however often the place of the oldest has gone round.

#include "drivers/sample.hpp"

#include <cstddef>
#include <memory>
#include <span>

namespace axiscal {

/// One piece of memory, mapped twice, end to end: what runs over the end of the first copy is seen
/// in the second, so no sample is ever moved. push() and pop() take the same time always: a vector
/// that is compacted moves tens of megabytes in one call, milliseconds of the loop. Pages that were
/// never reached cost nothing, and those of samples that are gone are given back, some 64 at a
/// time: what is held is what is alive and a quarter of a megabyte.
class SampleRing {
public:
    /// Room for `capacity` samples at least. Throws std::bad_alloc where the kernel gives no
    /// memory.
    explicit SampleRing(std::size_t capacity);

    [[nodiscard]] std::size_t size() const { return size_; }
    /// The oldest first; valid until the next push() or pop().
    [[nodiscard]] std::span<const Sample> all() const { return {places_.get() + first_, size_}; }
    /// Pre: size() < capacity.
    void push(const Sample& sample);
    /// Forgets the oldest. Pre: size() > 0.
    void pop();

private:
    struct Unmap {
        std::size_t bytes;
        void operator()(Sample* places) const;
    };
    static std::unique_ptr<Sample[], Unmap> mapped_twice(std::size_t bytes);
    void give_back_passed();

    std::size_t count_; ///< of places in one copy
    std::size_t step_;  ///< so many places are given back at once: whole pages, as count_
    std::unique_ptr<Sample[], Unmap> places_;
    std::size_t first_ = 0, size_ = 0;
    std::size_t passed_ = 0; ///< from here to first_ nothing was given back yet; whole pages
};

} // namespace axiscal
