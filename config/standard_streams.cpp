#include "config/standard_streams.hpp"

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <iostream>
#include <poll.h>
#include <system_error>
#include <unistd.h>

namespace axiscal {

void open_standard_streams() {
    int opened = 0;
    do { // open(2) takes the lowest number that is free
        opened = ::open("/dev/null", O_RDWR);
    } while (opened >= 0 && opened <= STDERR_FILENO);
    if (opened >= 0) ::close(opened);
}

class StandardOutput::Buffer final : public std::streambuf {
public:
    Buffer() { begin_anew(); }

    /// What went wrong first, 0 for nothing.
    [[nodiscard]] int end() {
        sync();
        const int copy = ::dup(STDOUT_FILENO); // a share tells of a full disk when a file is closed
        if ((copy < 0 || ::close(copy) != 0) && error_ == 0) error_ = errno;
        return error_;
    }

private:
    int_type overflow(int_type letter) override {
        if (sync() != 0) return traits_type::eof();
        if (traits_type::eq_int_type(letter, traits_type::eof()))
            return traits_type::not_eof(letter);
        return sputc(traits_type::to_char_type(letter));
    }

    int sync() override {
        for (const char* from = pbase(); from != pptr() && error_ == 0;) {
            const auto written =
                ::write(STDOUT_FILENO, from, static_cast<std::size_t>(pptr() - from));
            if (written >= 0)
                from += written;
            else
                wait_or_keep(errno);
        }
        begin_anew();
        return error_ == 0 ? 0 : -1;
    }

    /// A pipe that another program made non-blocking takes more in a moment.
    void wait_or_keep(int error) {
        pollfd output{STDOUT_FILENO, POLLOUT, 0};
        if (error == EAGAIN)
            ::poll(&output, 1, -1);
        else if (error != EINTR)
            error_ = error;
    }

    void begin_anew() { setp(room_.data(), room_.data() + room_.size()); }

    std::array<char, 1 << 16> room_{};
    int error_ = 0;
};

StandardOutput::StandardOutput()
    : buffer_{std::make_unique<Buffer>()}
    , before_{std::cout.rdbuf(buffer_.get())} {
    if (::isatty(STDOUT_FILENO) != 0) std::cout << std::unitbuf; // a person waits for each line
}

StandardOutput::~StandardOutput() {
    std::cout.rdbuf(before_);
}

int StandardOutput::end(std::string_view program, int code) {
    std::cout.flush();
    const int error = buffer_->end();
    if (error == 0) return code;
    if (error != EPIPE)
        std::cerr << program << ": could not write all of its output to standard output: "
                  << std::generic_category().message(error) << "\n";
    return code == 0 ? 1 : code;
}

} // namespace axiscal
