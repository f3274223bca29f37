#pragma once
// What the daemon says to systemd's journal, as systemd.exec(5) and systemd's page "Native Journal
// Protocol" describe it for programs that speak for themselves; of libsystemd see
// service_manager.hpp. The journal of runs is another (acquisition/journal).

#include "drivers/loop/log_line.hpp"

#include <string>
#include <string_view>
#include <sys/un.h>

namespace axiscal {

/// Whether it is the journal's, by device and inode as JOURNAL_STREAM names them.
bool leads_to_system_journal(int descriptor);

/// The datagram of one entry. A fact that is not there has no field. Whatever stands in a value, it
/// is the value of its field: one with a line feed is told with its length.
std::string journal_entry(const LogLine& line);

/// Belongs to the thread that writes.
class SystemJournal {
public:
    /// @param stream  leads to the journal, too; stays the caller's
    explicit SystemJournal(int stream, std::string_view socket = "/run/systemd/journal/socket");
    ~SystemJournal();
    SystemJournal(const SystemJournal&) = delete;
    SystemJournal& operator=(const SystemJournal&) = delete;

    /// With its facts as fields. What has none, or what the socket does not take, goes by the
    /// stream with its priority alone. Waits for a journal that hangs.
    void write(const LogLine& line) const;

private:
    [[nodiscard]] bool sent(std::string_view entry) const;

    int stream_, socket_;
    ::sockaddr_un address_{};
};

} // namespace axiscal
