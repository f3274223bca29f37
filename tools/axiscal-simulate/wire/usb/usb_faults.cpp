#include "wire/usb/usb_faults.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace axiscal::simulate {

Result<void> UsbFaults::set(const std::string& word, int number) {
    constexpr std::array words{std::pair{"none", UsbFault::none},
                               std::pair{"mute", UsbFault::mute},
                               std::pair{"stall", UsbFault::stall},
                               std::pair{"cut", UsbFault::cut},
                               std::pair{"corrupt", UsbFault::corrupt},
                               std::pair{"garble", UsbFault::garble},
                               std::pair{"descriptors", UsbFault::descriptors}};
    const auto found = std::find_if(words.begin(), words.end(),
                                    [&](const auto& row) { return word == row.first; });
    if (found == words.end())
        return fail(Fault::bad_request,
                    "\"" + word +
                        "\" is none of none, mute, stall, cut, corrupt, garble, descriptors");
    if (found->second == UsbFault::cut && number < 0)
        return fail(Fault::bad_request, "cut N keeps N bytes, 0 or more");
    const bool masks = found->second == UsbFault::corrupt || found->second == UsbFault::garble;
    if (masks && (number < 1 || number > 255))
        return fail(Fault::bad_request, word + " MASK needs a mask of 1 to 255");
    set(found->second, number);
    return {};
}

UsbAnswer UsbFaults::spoil(UsbAnswer answer) const {
    if (answer.how != UsbAnswer::How::done || answer.bytes.empty()) return answer;
    const int number = number_;
    if (fault_ == UsbFault::cut && answer.bytes.size() > static_cast<std::size_t>(number))
        answer.bytes.resize(static_cast<std::size_t>(number));
    if (fault_ == UsbFault::corrupt)
        answer.bytes[answer.bytes.size() / 2] ^= static_cast<std::uint8_t>(number);
    if (fault_ == UsbFault::garble)
        for (std::uint8_t& byte : answer.bytes)
            byte ^= static_cast<std::uint8_t>(number);
    return answer;
}

} // namespace axiscal::simulate
