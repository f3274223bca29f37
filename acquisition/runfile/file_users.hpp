#pragma once
// Who holds a lock on a file. Reads /proc/locks, proc_locks(5): to ask by fcntl(2) one would open
// the file, and closing it again drops SQLite's own locks in this process.

#include <string>

namespace axiscal {

/// "process 1234 (sqlite3)", several with "and"; the name is left out where this user must not see
/// it. "another program" where no other process is found: the file system numbers its files
/// otherwise there (btrfs), or the list cannot be read.
std::string file_users_text(const std::string& path, const std::string& list = "/proc/locks");

} // namespace axiscal
