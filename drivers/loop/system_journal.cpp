#include "drivers/loop/system_journal.hpp"

#include "drivers/loop/line_writer.hpp"

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal {
namespace {

void add_field(std::string& entry, std::string_view name, std::string_view value) {
    entry += name;
    if (value.find('\n') == std::string_view::npos) {
        entry += '=';
    } else {
        entry += '\n';
        const std::uint64_t size = value.size();
        for (unsigned shift = 0; shift < 64; shift += 8)
            entry += static_cast<char>(static_cast<unsigned char>(size >> shift));
    }
    entry += value;
    entry += '\n';
}

void add_fact(std::string& entry, std::string_view name, std::string_view value) {
    if (!value.empty()) add_field(entry, name, value);
}

} // namespace

bool leads_to_system_journal(int descriptor) {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): no other thread changes the environment
    const char* const named = std::getenv("JOURNAL_STREAM");
    struct ::stat file {};
    if (named == nullptr || ::fstat(descriptor, &file) != 0) return false;
    return std::to_string(file.st_dev) + ":" + std::to_string(file.st_ino) == named;
}

/// Identifier and facility are those that systemd gives to the lines of the stream.
std::string journal_entry(const LogLine& line) {
    std::string_view text = line.text;
    if (text.ends_with('\n')) text.remove_suffix(1);
    std::string entry;
    add_field(entry, "MESSAGE", text);
    add_field(entry, "PRIORITY", std::to_string(line.priority));
    add_field(entry, "SYSLOG_FACILITY", "3");
    add_field(entry, "SYSLOG_IDENTIFIER", "axiscald");
    if (line.facts.fault != Fault::none)
        add_field(entry, "AXISCAL_FAULT", fault_name(line.facts.fault));
    add_fact(entry, "AXISCAL_RUN", line.facts.run);
    add_fact(entry, "AXISCAL_INSTRUMENT", line.facts.instrument);
    return entry;
}

SystemJournal::SystemJournal(int stream, std::string_view socket)
    : stream_{stream}
    , socket_{::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)} {
    address_.sun_family = AF_UNIX;
    socket.copy(address_.sun_path, sizeof address_.sun_path - 1);
}

SystemJournal::~SystemJournal() {
    if (socket_ >= 0) ::close(socket_);
}

/// To a name and not connected: a journal that was restarted is found again.
bool SystemJournal::sent(std::string_view entry) const {
    for (;;) {
        const ssize_t count =
            ::sendto(socket_, entry.data(), entry.size(), MSG_NOSIGNAL,
                     reinterpret_cast<const ::sockaddr*>(&address_), sizeof address_);
        if (count >= 0 || errno != EINTR) return count >= 0;
    }
}

/// The journal knows whose stream it reads. The sender of a datagram it looks up, and may find that
/// it has ended: last words, which are about nothing, would not be found by the unit's name.
void SystemJournal::write(const LogLine& line) const {
    if (line.facts.any() && sent(journal_entry(line))) return;
    write_all(stream_, "<" + std::to_string(line.priority) + ">" + line.text);
}

} // namespace axiscal
