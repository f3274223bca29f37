#pragma once
// A serial line without hardware: we hold the master end, the device under test opens `path()`.
// Tests only.

#include <cstdlib>
#include <fcntl.h>
#include <stdexcept>
#include <string>
#include <termios.h>
#include <unistd.h>

namespace axiscal::testing {

class PtyLine {
public:
    PtyLine()
        : master_{::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK)} {
        char name[64];
        if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0 ||
            ::ptsname_r(master_, name, sizeof name) != 0)
            throw std::runtime_error("no pseudo terminal");
        path_ = name;
        termios raw{};
        ::tcgetattr(master_, &raw);
        ::cfmakeraw(&raw); // no echo before the device is opened
        ::tcsetattr(master_, TCSANOW, &raw);
    }
    ~PtyLine() { ::close(master_); } // the other end sees a hang-up
    PtyLine(const PtyLine&) = delete;
    PtyLine& operator=(const PtyLine&) = delete;
    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] int master() const { return master_; }

private:
    int master_;
    std::string path_;
};

} // namespace axiscal::testing
