#pragma once
// Bytes to lines, with a bound. No I/O, no allocation after the first line. Pure.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace axiscal {

/// Splits at LF and drops a CR before it (or at CR, for instruments that send no LF). A line longer
/// than the bound is dropped whole and counted. With `skip_first` everything up to the first LF is
/// dropped too: a link that is opened in the middle of a record begins with half a line that may
/// look like a whole one.
class LineFramer {
public:
    explicit LineFramer(std::size_t longest, bool skip_first = false, char line_end = '\n')
        : longest_{longest}
        , line_end_{line_end}
        , skipping_{skip_first} {}

    /// Calls `on_line(std::string_view)` for each complete line; the view ends with the call.
    /// @returns how many lines these bytes made longer than the bound: bad frames to be counted.
    template <class OnLine>
    [[nodiscard]] std::uint64_t feed(std::span<const std::byte> bytes, OnLine&& on_line) {
        std::string_view rest{reinterpret_cast<const char*>(bytes.data()), bytes.size()};
        for (auto end = rest.find(line_end_); end != std::string_view::npos;
             end = rest.find(line_end_)) {
            finish(rest.substr(0, end), on_line);
            rest.remove_prefix(end + 1);
        }
        keep(rest);
        return std::exchange(oversized_, 0);
    }

private:
    template <class OnLine> void finish(std::string_view tail, OnLine& on_line) {
        const bool whole_line_at_hand = partial_.empty() && !skipping_ && tail.size() <= longest_;
        if (whole_line_at_hand) return on_line(without_return(tail));
        keep(tail);
        if (!skipping_) on_line(without_return(partial_));
        partial_.clear();
        skipping_ = false;
    }
    void keep(std::string_view tail) {
        if (skipping_) return;
        if (partial_.size() + tail.size() <= longest_) {
            partial_.append(tail);
            return;
        }
        ++oversized_;
        partial_.clear();
        skipping_ = true;
    }
    static std::string_view without_return(std::string_view line) {
        if (line.ends_with('\r')) line.remove_suffix(1);
        return line;
    }

    std::string partial_;
    std::size_t longest_;
    std::uint64_t oversized_ = 0; ///< in this call of feed()
    char line_end_;
    bool skipping_;
};

} // namespace axiscal
