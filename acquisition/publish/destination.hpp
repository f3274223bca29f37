#pragma once
// Where results go: a folder or a share. Paths are relative to its root, with '/', "" is the root.
// For one thread; every call may block for as long as the other side lets it.

#include "analysis/quantity/result.hpp"

#include <functional>
#include <string>
#include <vector>

namespace axiscal {

/// Called while bytes move, so that a watchdog sees a slow share apart from a dead one.
using Progress = std::function<void()>;

/// No result can go there now: server, network, account or full disk are at fault, not this path.
/// An Error of Fault::io that is_share_lost() knows; `detail` is the whole sentence for people.
tl::unexpected<Error> share_lost(std::string detail, int error = 0);
bool is_share_lost(const Error& error);
/// The sentence of a lost share with the system's word; describe() of any other error.
std::string publishing_text(const Error& error);

/// @errors of every call: share_lost(), or Fault::io when it is about this path alone. Both name
/// place and way out.
class Destination {
public:
    Destination() = default;
    virtual ~Destination() = default;
    Destination(const Destination&) = delete;
    Destination& operator=(const Destination&) = delete;

    /// The root as a person knows it: "/mnt/quality", "smb://server/share/folder".
    [[nodiscard]] virtual std::string place() const = 0;
    /// Makes ready what needs no word to the other side.
    /// @returns whether none was said yet: a process forked now may use it as its own.
    virtual bool prepare() { return true; }
    /// The root is there. It is never made: that could fill an unmounted mount point.
    virtual Result<void> check() = 0;
    /// true: made by this call, hence empty; false: something of that name is there already.
    virtual Result<bool> make_folder(const std::string& path) = 0;
    /// Every name in it. @errors Fault::refused when it is no folder.
    virtual Result<std::vector<std::string>> names_in(const std::string& folder) = 0;
    virtual Result<std::string> sha256_of(const std::string& path, const Progress& progress) = 0;
    /// Creates or replaces `path` with the content of the local file `source`, flushes as far as
    /// the other side lets itself be asked, reads it back from there and returns that SHA-256.
    virtual Result<std::string> write_and_read_back(const std::string& source,
                                                    const std::string& path,
                                                    const Progress& progress) = 0;
    /// Leaves what bears the name `to` as it is. @errors Fault::refused when it is taken.
    virtual Result<void> move_to_free_name(const std::string& from, const std::string& to) = 0;
    /// A file that is not there is no error.
    virtual Result<void> remove_file(const std::string& path) = 0;
    /// Names in the folder outlast a power cut, as far as the other side lets itself be asked.
    virtual Result<void> sync_folder(const std::string& path) = 0;
};

} // namespace axiscal
