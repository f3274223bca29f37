#pragma once
// A byte that came with a wrong parity or a broken frame spoils what it stands in: termios(3),
// PARMRK without IGNPAR. Such a byte is read as FF 00 x, a good FF as FF FF. Pure.

#include <cstddef>
#include <span>
#include <vector>

namespace axiscal {

/// Undoes the marks over any cuts between reads.
class ParityMarks {
public:
    /// Stands for a spoilt byte: no digit, no letter, no end of a line; and a byte that was changed
    /// on its way fails every checksum, whatever it is changed to.
    static constexpr std::byte spoilt{0xFF};
    /// May be empty: a mark has begun.
    std::vector<std::byte> undo(std::span<const std::byte> marked);

private:
    int of_a_mark_ = 0; ///< bytes of one that came
};

} // namespace axiscal
