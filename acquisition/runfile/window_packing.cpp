#include "acquisition/runfile/window_packing.hpp"

#include "acquisition/runfile/folding.hpp"

#include <bit>

namespace axiscal {
namespace {

constexpr std::size_t longest_number = 10; ///< bytes of seven bits for 64
constexpr std::size_t columns = 3;         ///< times, readings, sample numbers
constexpr unsigned goes_on = 0x80;

/// LEB128: seven bits a byte, the lowest first.
void put_number(char*& place, std::uint64_t word) {
    for (; word >= goes_on; word >>= 7U)
        *place++ = static_cast<char>(static_cast<unsigned char>(word | goes_on));
    *place++ = static_cast<char>(static_cast<unsigned char>(word));
}

/// Numbers from the front of bytes. After the first that is none, each is 0 and `whole` tells it.
class NumberReader {
public:
    explicit NumberReader(std::string_view bytes)
        : rest_{bytes} {}
    std::uint64_t next() {
        std::uint64_t word = 0;
        for (unsigned shift = 0; shift < 64; shift += 7) {
            if (rest_.empty()) break;
            const auto byte = static_cast<unsigned char>(rest_.front());
            rest_.remove_prefix(1);
            const std::uint64_t bits = byte & ~goes_on;
            if (bits << shift >> shift != bits || (byte == 0 && shift > 0)) break;
            word |= bits << shift;
            if ((byte & goes_on) == 0) return word;
        }
        return whole_ = false, 0;
    }
    [[nodiscard]] std::size_t left() const { return rest_.size(); }
    [[nodiscard]] bool whole() const { return whole_; }

private:
    std::string_view rest_;
    bool whole_ = true;
};

/// What a column goes up by, and what that goes up by: nearly always 0 of even steps.
class SecondDifferences {
public:
    std::uint64_t of(std::uint64_t word) {
        const std::uint64_t step = word - std::exchange(last_, word);
        return folded(step - std::exchange(step_, step));
    }
    std::uint64_t back(std::uint64_t folded) {
        step_ += unfolded(folded);
        return last_ += step_;
    }

private:
    std::uint64_t last_ = 0, step_ = 0;
};

std::uint64_t time_of(const WindowSample& sample) {
    return static_cast<std::uint64_t>(nanoseconds_of(sample.at));
}

} // namespace

std::string packed_window(std::span<const WindowSample> samples) {
    std::string bytes(longest_number * (1 + columns * samples.size()), '\0');
    char* place = bytes.data();
    put_number(place, samples.size());
    SecondDifferences times, numbers;
    for (const WindowSample& sample : samples)
        put_number(place, times.of(time_of(sample)));
    std::uint64_t last = 0;
    for (const WindowSample& sample : samples) {
        const auto bits = std::bit_cast<std::uint64_t>(sample.reading_m);
        put_number(place, folded(bits - std::exchange(last, bits)));
    }
    for (const WindowSample& sample : samples)
        put_number(place, numbers.of(sample.device_count));
    bytes.resize(static_cast<std::size_t>(place - bytes.data()));
    return bytes;
}

std::optional<std::vector<WindowSample>> unpacked_window(std::string_view bytes) {
    NumberReader in{bytes};
    const std::uint64_t count = in.next();
    if (count > in.left() / columns) return std::nullopt; // a number has a byte at least
    std::vector<WindowSample> samples(count);
    SecondDifferences times, numbers;
    for (WindowSample& sample : samples)
        sample.at = monotonic_from_ns(static_cast<std::int64_t>(times.back(in.next())));
    std::uint64_t bits = 0;
    for (WindowSample& sample : samples)
        sample.reading_m = std::bit_cast<double>(bits += unfolded(in.next()));
    for (WindowSample& sample : samples)
        sample.device_count = numbers.back(in.next());
    if (!in.whole() || in.left() != 0) return std::nullopt;
    return samples;
}

} // namespace axiscal
