#pragma once
// While a run is open this computer must not fall asleep. systemd-inhibit(1) asks logind for it, a
// program of systemd that comes with it: libsystemd would stay in an idle daemon's memory
// (drivers/loop/service_manager.hpp). Loop-bound; nothing here waits.

#include "drivers/loop/child_process.hpp"
#include "drivers/loop/scheduler.hpp"

#include <string>

namespace axiscal {

class SleepLock {
public:
    /// `program`: systemd-inhibit; empty: nobody is asked.
    SleepLock(Scheduler& scheduler, std::string program);
    ~SleepLock();
    SleepLock(const SleepLock&) = delete;
    SleepLock& operator=(const SleepLock&) = delete;

    /// As often as one likes. What was refused is asked again when it is wanted anew.
    void want(bool wanted);
    /// Asks once and lets go: refusal() tells beforehand.
    void try_out();
    [[nodiscard]] bool held() const { return held_; }
    /// Why the computer may fall asleep although it is not wanted, in the program's words; empty:
    /// the lock was given, or nobody has answered yet.
    [[nodiscard]] const std::string& refusal() const { return refusal_; }
    /// For how long the computer slept, locked or not, since this was told last, or since the
    /// start; 0: not noticeably.
    Duration slept_in_spite_of_it();

private:
    void ask();
    void let_go();
    Task<void> hold_while_wanted(ChildProcess child);

    Scheduler& scheduler_;
    std::string program_;
    std::string refusal_;
    Duration slept_; ///< as told last
    int input_ = -1; ///< the lock lasts until it is closed, by us or by our end
    bool wanted_ = false, asking_ = false, held_ = false;
};

} // namespace axiscal
