#pragma once
// What a USB serial adapter has on its far side: a terminal that some wire face of the simulated
// world serves (the µMD counter, a Dracal stick). One thread.

#include "wire/usb/usb_device.hpp"

namespace axiscal::simulate {

class TtyBehind {
public:
    /// @errors io: the path can not be opened.
    static Result<TtyBehind> open(const std::string& path);
    TtyBehind(TtyBehind&& other) noexcept;
    TtyBehind(const TtyBehind&) = delete;
    TtyBehind& operator=(const TtyBehind&) = delete;
    TtyBehind& operator=(TtyBehind&&) = delete;
    ~TtyBehind();

    [[nodiscard]] bool has_bytes() const;
    /// What is there, at most this many bytes; empty when nothing is, or the face has gone.
    [[nodiscard]] Bytes read(std::size_t most) const;
    void write(std::span<const std::uint8_t> bytes) const;
    /// Throws away what came while nobody was plugged in.
    void flush() const;
    [[nodiscard]] int descriptor() const { return descriptor_; }

private:
    explicit TtyBehind(int descriptor)
        : descriptor_{descriptor} {}
    int descriptor_;
};

} // namespace axiscal::simulate
