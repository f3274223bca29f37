// Records of the kernel's counter device. The first byte chooses the register's width, the rest are
// records as a pipe may cut them.

#include "drivers/laser/counter_record.hpp"
#include "tests/fuzz/judge.hpp"

#include <limits>
#include <span>

using namespace axiscal;

namespace {

std::vector<CounterRecord> byte_by_byte(std::span<const std::byte> bytes) {
    CounterFramer framer;
    std::vector<CounterRecord> all;
    for (const std::byte& byte : bytes)
        for (const CounterRecord& record : framer.feed({&byte, 1}))
            all.push_back(record);
    return all;
}

void judge_counts(const std::vector<CounterRecord>& records, int bits) {
    const std::uint64_t seen = std::numeric_limits<std::uint64_t>::max() >> (64 - bits);
    CountUnwrapper unwrapper{bits};
    for (const CounterRecord& record : records) {
        const auto total = static_cast<std::uint64_t>(unwrapper.unwrap(record.value));
        fuzz::require(((total ^ record.value) & seen) == 0,
                      "the register is the low end of the long number");
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto bytes = std::as_bytes(std::span{data, size});
    if (bytes.empty()) return 0;
    const int bits = 8 + data[0] % 57;
    CounterFramer at_once;
    const auto whole = at_once.feed(bytes.subspan(1)), split = byte_by_byte(bytes.subspan(1));
    fuzz::require(whole.size() == (size - 1) / counter_record_bytes, "24 bytes make a record");
    fuzz::require(whole.size() == split.size(), "reads that split a record change nothing");
    for (std::size_t i = 0; i < whole.size(); ++i)
        fuzz::require(whole[i].at_ns == split[i].at_ns && whole[i].value == split[i].value,
                      "reads that split a record change nothing");
    judge_counts(whole, bits);
    return 0;
}
