#pragma once
// One object of a CANopen node is read or written: service data objects, from the client's side.
// Pure.

#include "analysis/quantity/result.hpp"
#include "drivers/wire/can_frame.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// Of the object dictionary: 0x1A00:01.
struct ObjectKey {
    std::uint16_t index = 0;
    std::uint8_t sub = 0;
    friend bool operator==(const ObjectKey&, const ObjectKey&) = default;
};
std::string name_of(ObjectKey key);

/// What an abort code means; "no reason that is known" for one of nobody's.
std::string_view sdo_abort_reason(std::uint32_t code);

/// Content in one frame (expedited) or, when read, in segments. Of node 1 to 127.
class SdoTransfer {
public:
    static SdoTransfer read(int node, ObjectKey key);
    /// `bytes` 1 to 4, the low one first.
    static SdoTransfer write(int node, ObjectKey key, std::uint32_t value, int bytes);

    /// What is to be sent now.
    [[nodiscard]] const CanFrame& request() const { return request_; }
    enum class Step : std::uint8_t {
        ignored, ///< no answer to this: another node's, or to a question given up before
        more,    ///< request() is to be sent, then
        done,
    };
    /// @errors Fault::refused with the node's reason; bad_frame for an answer that cannot be one.
    Result<Step> take(const CanFrame& frame);
    /// What was read, once done.
    [[nodiscard]] const std::vector<std::byte>& content() const { return content_; }
    [[nodiscard]] ObjectKey key() const { return key_; }

    static constexpr std::size_t longest_content = 1024;

private:
    SdoTransfer(int node, ObjectKey key);
    [[nodiscard]] bool about_it(const CanFrame& frame) const;
    [[nodiscard]] tl::unexpected<Error> broken(const char* how) const;
    [[nodiscard]] tl::unexpected<Error> aborted(const CanFrame& frame) const;
    Result<Step> take_beginning(const CanFrame& frame, unsigned command);
    Result<Step> take_segment(const CanFrame& frame, unsigned command);
    void ask_segment();

    int node_ = 0;
    ObjectKey key_;
    enum class Stage : std::uint8_t { writing, beginning, segments } stage_ = Stage::beginning;
    CanFrame request_;
    std::vector<std::byte> content_;
    std::size_t announced_ = 0; ///< 0: not told
    unsigned toggle_ = 0;       ///< of the segment that is awaited
};

} // namespace axiscal
