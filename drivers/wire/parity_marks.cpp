#include "drivers/wire/parity_marks.hpp"

namespace axiscal {

std::vector<std::byte> ParityMarks::undo(std::span<const std::byte> marked) {
    constexpr std::byte mark{0xFF};
    std::vector<std::byte> bytes;
    bytes.reserve(marked.size());
    for (const std::byte byte : marked) {
        if (of_a_mark_ == 2) {
            bytes.push_back(spoilt);
            of_a_mark_ = 0;
        } else if (of_a_mark_ == 1) {
            of_a_mark_ = byte == std::byte{0} ? 2 : 0;
            if (of_a_mark_ == 0) bytes.push_back(byte); // a good FF
        } else if (byte == mark) {
            of_a_mark_ = 1;
        } else {
            bytes.push_back(byte);
        }
    }
    return bytes;
}

} // namespace axiscal
