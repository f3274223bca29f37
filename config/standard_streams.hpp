#pragma once
// The three descriptors that every program is started with. Called from main, before threads.

#include <memory>
#include <streambuf>
#include <string_view>

namespace axiscal {

/// First thing in main. Of the descriptors 0 to 2 those that are closed are opened on /dev/null: a
/// file that is opened later would get their number, and what is meant for a person would be
/// written into it.
void open_standard_streams();

/// While it lives, std::cout writes to descriptor 1 by itself and keeps the first error: a stream
/// tells only that there was one. Nothing of the program may write there by stdio.
class StandardOutput {
public:
    StandardOutput();
    ~StandardOutput();
    StandardOutput(const StandardOutput&) = delete;
    StandardOutput& operator=(const StandardOutput&) = delete;

    /// Writes what is left. Where not all could be written, standard error tells so with the
    /// system's word; of a reader that has heard enough (EPIPE) it tells nothing.
    /// @returns `code`, or 1 in place of 0 where not all was written
    [[nodiscard]] int end(std::string_view program, int code);

private:
    class Buffer;
    std::unique_ptr<Buffer> buffer_;
    std::streambuf* before_; ///< what std::cout wrote to
};

} // namespace axiscal
