#pragma once
// Finds the frames on a Modbus RTU line that others speak on too. Pure.
//
// The protocol divides frames by 3.5 characters of silence. A host does not see them: an adapter
// hands bytes over in lumps, up to 16 ms late. So a frame's length is taken from its function code
// and its end from its checksum; only what stays unfinished is ended by a much longer silence.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace axiscal {

class RtuFramer {
public:
    static constexpr std::size_t longest_frame = 256; ///< Modbus over serial line V1.02, 2.5.1

    /// @param unit  our address. A frame that bears it is a request; one with another may be a
    /// request or its answer, and a request to a slave that is not there has no answer.
    explicit RtuFramer(std::uint8_t unit)
        : unit_{unit} {}

    void feed(std::span<const std::uint8_t> bytes);
    /// The line was silent: what waits for more bytes gets none.
    void silence() { silent_ = true; }
    /// The next frame with a good checksum, from address to checksum, of whomever. Call it until it
    /// is empty: more bytes or a silence are then needed.
    std::optional<std::vector<std::uint8_t>> next();

    [[nodiscard]] bool pending() const { return begin_ < bytes_.size(); }
    [[nodiscard]] std::uint64_t noise() const { return noise_; } ///< bytes that were no frame's

private:
    [[nodiscard]] std::span<const std::uint8_t> rest() const;
    std::vector<std::uint8_t> cut(std::size_t length);

    std::uint8_t unit_;
    std::vector<std::uint8_t> bytes_; ///< less than a frame, and what was fed last
    std::size_t begin_ = 0;           ///< of what is not used up
    bool silent_ = false;
    bool in_step_ = true; ///< a frame or a silence ended before this byte
    std::uint64_t noise_ = 0;
};

} // namespace axiscal
