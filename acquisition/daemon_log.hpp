#pragma once
// The daemon's log: text on stderr, or entries of systemd's journal where that is stderr.

namespace axiscal {

/// While it lives, whatever the process logs goes there, and nobody who logs waits for it. Its end
/// writes what is kept.
class DaemonLog {
public:
    DaemonLog();
    ~DaemonLog();
    DaemonLog(const DaemonLog&) = delete;
    DaemonLog& operator=(const DaemonLog&) = delete;
};

} // namespace axiscal
