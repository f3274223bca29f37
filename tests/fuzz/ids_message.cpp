// Lines of an attocube IDS3010.

#include "drivers/laser/ids_message.hpp"
#include "tests/fuzz/judge.hpp"

#include <algorithm>
#include <cmath>

using namespace axiscal;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t longest_line = 4096; // a longer one never leaves the framer
    const auto reply = parse_ids_reply(fuzz::as_text(data, std::min(size, longest_line)));
    if (!reply) {
        fuzz::require(!reply.error().detail.empty(), "a refusal has a reason");
        return 0;
    }
    for (std::size_t place = 0; place <= reply->values.size(); ++place) {
        const auto number = number_of(*reply, place);
        const bool there = place < reply->values.size();
        fuzz::require(!number || (there && std::isfinite(*number)), "no NaN leaves the decoder");
        fuzz::require(there || (!whole_number_of(*reply, place) && text_of(*reply, place).empty()),
                      "nothing stands behind the end");
    }
    IdsCompensation found;
    found.mode = whole_number_of(*reply, 0).value_or(0);
    found.index = number_of(*reply, 1).value_or(1);
    found.unit_connected = whole_number_of(*reply, 2).value_or(0) != 0;
    const bool silent = correction_of_its_own(found).empty();
    fuzz::require(!silent || std::abs(found.index - 1) < 1e-6, "air is never corrected twice");
    return 0;
}
