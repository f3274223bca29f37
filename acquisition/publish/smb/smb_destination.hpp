#pragma once
// A share of an SMB server, spoken to by libsmbclient (Samba, GPL-3.0-or-later): the only place
// that links it. One context and one thread for the life of the process, because the library of
// Debian 12 aborts with two. SMB 3 encrypted, or where the station file says so from SMB 2.1 on and
// signed.

#include "acquisition/publish/destination.hpp"
#include "acquisition/publish/smb/share_account.hpp"
#include "analysis/quantity/time.hpp"
#include "config/share_address.hpp"

#include <memory>
#include <optional>

namespace axiscal {

struct SmbSettings {
    ShareAddress address;
    std::string credentials; ///< as read_share_account() takes it
    bool require_encryption = true;
    Duration timeout = std::chrono::seconds{10}; ///< of one call; it may take one second more
};

/// After a lost share the session is given up; the next check() opens another one with the
/// account as the file then says. libsmbclient knows no flush: what the server's own disk holds
/// after a power cut there is the server's to promise (docs/share.md).
class SmbDestination final : public Destination {
public:
    explicit SmbDestination(SmbSettings settings);
    ~SmbDestination() override;
    SmbDestination(const SmbDestination&) = delete;
    SmbDestination& operator=(const SmbDestination&) = delete;
    [[nodiscard]] std::string place() const override;
    bool prepare() override;
    Result<void> check() override;
    Result<bool> make_folder(const std::string& path) override;
    Result<std::vector<std::string>> names_in(const std::string& folder) override;
    Result<std::string> sha256_of(const std::string& path, const Progress& progress) override;
    /// Read back over the same open file: the server's answer, for the library keeps no copy.
    Result<std::string> write_and_read_back(const std::string& source,
                                            const std::string& path,
                                            const Progress& progress) override;
    /// By the server's own rename, which refuses a name that is taken. On a share of a DFS
    /// namespace by a look before it: what is made between the two, of the order of a millisecond,
    /// is not seen.
    Result<void> move_to_free_name(const std::string& from, const std::string& to) override;
    Result<void> remove_file(const std::string& path) override;
    Result<void> sync_folder(const std::string& path) override;

private:
    class Session;
    Result<void> open_session();
    [[nodiscard]] std::string url(const std::string& path) const;
    /// Words for errno of a call; where the share is lost, the session ends with the next call, for
    /// open files still belong to it.
    tl::unexpected<Error> refused(const std::string& what, const std::string& path, int error);
    tl::unexpected<Error> lost(int error);
    Result<void> look_and_rename(const std::string& from, const std::string& to);
    /// As the library does it; false: errno says why.
    bool rename(const std::string& from, const std::string& to);
    [[nodiscard]] tl::unexpected<Error> taken(const std::string& path) const;

    SmbSettings settings_;
    std::string root_url_;
    std::unique_ptr<Session> session_;
    bool session_used_ = false; ///< something was said to the server in it
    bool session_lost_ = false;
    bool looks_before_renames_ = false; ///< seen: this share asks more than a rename
};

/// "libsmbclient 4.17.12-Debian".
std::string smb_library_name();

} // namespace axiscal
