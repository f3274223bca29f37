#include "acquisition/publish/smb/smb_session.hpp"
#include "acquisition/publish/smb/wire_watch.hpp"

#include "acquisition/runfile/digest.hpp"
#include "acquisition/runfile/durable_file.hpp"

#include <algorithm>
#include <array>
#include <fcntl.h>
#include <limits>
#include <optional>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal {
namespace {

constexpr std::size_t block = 1U << 20U; // what SMB 3 carries at once

/// Errors that concern one name; with any other one no result would fare better.
bool of_one_path(int error) {
    constexpr std::array all{EEXIST, EACCES, EPERM,   ENOENT,       EISDIR, ENOTDIR,
                             EBUSY,  EINVAL, ETXTBSY, ENAMETOOLONG, EMLINK};
    return std::ranges::find(all, error) != all.end();
}

std::string escaped(const std::string& path) {
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                       "0123456789-._/";
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string text;
    for (const char letter : path) {
        const auto byte = static_cast<unsigned char>(letter);
        if (plain.find(letter) != std::string_view::npos)
            text += letter;
        else
            text += {'%', digits[byte >> 4U], digits[byte & 15U]};
    }
    return text;
}

/// Of the first `size` bytes, or up to the end where the file is shorter. Empty when reading fails;
/// errno says why.
std::optional<std::string> hash_of(SmbFile& file, std::uint64_t size, const Progress& progress) {
    Sha256 hash;
    std::vector<char> bytes(std::min<std::uint64_t>(size, block));
    while (size > 0) {
        const auto got = file.read(bytes.data(), std::min<std::uint64_t>(size, bytes.size()));
        if (got < 0) return std::nullopt;
        if (got == 0) break;
        hash.add({bytes.data(), static_cast<std::size_t>(got)});
        size -= static_cast<std::uint64_t>(got);
        if (progress) progress();
    }
    return hex_of(hash.finish());
}

bool write_all(SmbFile& file, const char* bytes, ssize_t size) {
    for (ssize_t done = 0; done < size;) {
        const auto put = file.write(bytes + done, static_cast<std::size_t>(size - done));
        if (put <= 0) return false;
        done += put;
    }
    return true;
}

/// What the system's word means here, and what to do.
std::string words_for(int error, const std::string& user) {
    switch (error) {
    case EACCES:
    case EPERM:
        return "the server refuses the account \"" + user +
               "\": name, password, or its right to write there";
    case ENOENT:
    case ENODEV:
        return "the server has no such share or folder: make it, or correct publish.destination";
    case ECONNREFUSED: return "no SMB server answers at that port";
    case ETIMEDOUT: return "the server does not answer in time";
    case EHOSTUNREACH:
    case ENETUNREACH:
    case EHOSTDOWN: return "the server cannot be reached: look for its name, cable and network";
    case ECONNABORTED:
    case ECONNRESET:
    case EPIPE: return "the server ended the connection";
    case ENOSPC:
    case EDQUOT: return "the share is full: make room there";
    case ENOSYS:
    case EPROTO:
    case EOPNOTSUPP:
        return "the server does not speak SMB 3 with encryption: switch it on there, or see "
               "publish.encryption";
    case EROFS: return "the share is closed to writing";
    default: return "the server does not take it";
    }
}

} // namespace

SmbDestination::SmbDestination(SmbSettings settings)
    : settings_{std::move(settings)}
    , root_url_{"smb://" + settings_.address.server + "/" + escaped(settings_.address.share)} {
    if (!settings_.address.folder.empty()) root_url_ += "/" + escaped(settings_.address.folder);
}

SmbDestination::~SmbDestination() = default;

std::string SmbDestination::place() const {
    return address_text(settings_.address);
}

std::string SmbDestination::url(const std::string& path) const {
    return path.empty() ? root_url_ : root_url_ + "/" + escaped(path);
}

Result<void> SmbDestination::open_session() {
    if (std::exchange(session_lost_, false)) session_.reset();
    if (session_) return {};
    auto account = read_share_account(settings_.credentials);
    if (!account) return share_lost(place() + ": " + describe(account.error()));
    auto session = std::make_unique<Session>(*std::move(account), settings_);
    if (!*session) return fail_io("cannot begin with", smb_library_name());
    session_ = std::move(session);
    session_used_ = false;
    forbid_readable_frames(settings_.require_encryption);
    return {};
}

tl::unexpected<Error> SmbDestination::lost(int error) {
    session_lost_ = true;
    const std::string user = session_ ? session_->account().user : "";
    return share_lost(place() + ": " + words_for(error, user), error);
}

tl::unexpected<Error>
SmbDestination::refused(const std::string& what, const std::string& path, int error) {
    if (!of_one_path(error)) return lost(error);
    return fail_io(what, place() + "/" + path, error);
}

// Where the account cannot be read check() tells it.
bool SmbDestination::prepare() {
    return open_session() && !session_used_;
}

// A session that was open may have died unseen: one call more tells a dead session from a dead
// server.
Result<void> SmbDestination::check() {
    AXISCAL_CHECK(open_session());
    const bool used_before = std::exchange(session_used_, true);
    struct stat status {};
    SMBCCTX* const context = session_->context();
    const WireCount before = smb_frames();
    const bool there = smbc_getFunctionStat(context)(context, root_url_.c_str(), &status) == 0;
    const int answer = errno;
    const WireCount sent = smb_frames();
    const bool held_back = sent.held_back > before.held_back;
    if (there && settings_.require_encryption && sent.encrypted == before.encrypted)
        return lost(EPROTO); // whatever that was, it was not seen to be encrypted
    if (there && S_ISDIR(status.st_mode)) return {};
    const int error = there ? ENOENT : held_back ? EPROTO : answer;
    if (!used_before) return lost(error);
    session_.reset();
    return check();
}

Result<bool> SmbDestination::make_folder(const std::string& path) {
    constexpr mode_t folder_mode = 0775;
    AXISCAL_CHECK(open_session());
    SMBCCTX* const context = session_->context();
    if (smbc_getFunctionMkdir(context)(context, url(path).c_str(), folder_mode) == 0) return true;
    if (errno == EEXIST) return false;
    return lost(errno);
}

Result<std::vector<std::string>> SmbDestination::names_in(const std::string& folder) {
    AXISCAL_CHECK(open_session());
    SMBCCTX* const context = session_->context();
    SMBCFILE* const list = smbc_getFunctionOpendir(context)(context, url(folder).c_str());
    if (!list && (errno == ENOTDIR || errno == EINVAL))
        return fail(Fault::refused, place() + "/" + folder + " is no folder");
    if (!list) return refused("cannot list", folder, errno);
    std::vector<std::string> names;
    errno = 0;
    while (const smbc_dirent* const one = smbc_getFunctionReaddir(context)(context, list)) {
        const std::string name{one->name, one->namelen};
        if (name != "." && name != "..") names.push_back(name);
    }
    const int error = errno;
    smbc_getFunctionClosedir(context)(context, list);
    if (error != 0) return refused("cannot list", folder, error);
    return names;
}

Result<std::string> SmbDestination::sha256_of(const std::string& path, const Progress& progress) {
    AXISCAL_CHECK(open_session());
    SmbFile file{session_->context(), url(path), O_RDONLY};
    if (!file) return refused("cannot open", path, errno);
    auto hash = hash_of(file, std::numeric_limits<std::uint64_t>::max(), progress);
    const int error = errno;
    if (hash && file.close()) return *std::move(hash);
    return refused("cannot read", path, hash ? errno : error);
}

Result<std::string> SmbDestination::write_and_read_back(const std::string& source,
                                                        const std::string& path,
                                                        const Progress& progress) {
    AXISCAL_CHECK(open_session());
    const FileHandle from{::open(source.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC)};
    if (!from) return fail_io("cannot open", source);
    SmbFile to{session_->context(), url(path), O_RDWR | O_CREAT | O_TRUNC};
    if (!to) return refused("cannot write", path, errno);
    std::vector<char> bytes(block_for(from));
    std::uint64_t size = 0;
    for (;;) {
        const auto got = ::read(from.get(), bytes.data(), bytes.size());
        if (got == 0) break;
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return fail_io("cannot read", source);
        if (!write_all(to, bytes.data(), got)) return refused("cannot write", path, errno);
        size += static_cast<std::uint64_t>(got);
        if (progress) progress();
    }
    auto hash = to.rewind() ? hash_of(to, size, progress) : std::nullopt;
    if (!hash || !to.close()) return refused("the share did not take", path, errno);
    return *std::move(hash);
}

// The server refuses to rename to a name that is taken. libsmbclient answers by deleting what bears
// it and renaming again, so not one frame more than a rename needs may leave: opened, renamed,
// closed. With what it wanted to say behind them the session is lost, the name is not.
Result<void> SmbDestination::move_to_free_name(const std::string& from, const std::string& to) {
    AXISCAL_CHECK(open_session());
    if (looks_before_renames_) return look_and_rename(from, to);
    constexpr unsigned frames_of_a_rename = 3;
    const auto held_before = smb_frames().held_back;
    allow_file_frames(frames_of_a_rename);
    const bool renamed = rename(from, to);
    const int error = errno;
    allow_file_frames(any_number);
    session_lost_ = smb_frames().held_back > held_before;
    if (renamed) return {};
    if (error == EEXIST) return taken(to);
    if (!session_lost_) return refused("cannot rename to", to, error);
    looks_before_renames_ = true;
    return move_to_free_name(from, to);
}

// On a share of a DFS namespace the library asks where a path leads before it renames, by frames of
// which nobody can tell how many: none may be forbidden. A program that makes the very name between
// look and rename loses its file. Nobody but this station makes names in the folder of its runs.
Result<void> SmbDestination::look_and_rename(const std::string& from, const std::string& to) {
    SMBCCTX* const context = session_->context();
    struct stat status {};
    if (smbc_getFunctionStat(context)(context, url(to).c_str(), &status) == 0) return taken(to);
    if (errno != ENOENT) return refused("cannot look for", to, errno);
    if (rename(from, to)) return {};
    return errno == EEXIST ? taken(to) : refused("cannot rename to", to, errno);
}

bool SmbDestination::rename(const std::string& from, const std::string& to) {
    SMBCCTX* const context = session_->context();
    return smbc_getFunctionRename(context)(context, url(from).c_str(), context, url(to).c_str()) ==
           0;
}

tl::unexpected<Error> SmbDestination::taken(const std::string& path) const {
    return fail(Fault::refused, place() + "/" + path + " exists already and is never overwritten");
}

Result<void> SmbDestination::remove_file(const std::string& path) {
    AXISCAL_CHECK(open_session());
    SMBCCTX* const context = session_->context();
    if (smbc_getFunctionUnlink(context)(context, url(path).c_str()) == 0 || errno == ENOENT)
        return {};
    return refused("cannot remove", path, errno);
}

Result<void> SmbDestination::sync_folder(const std::string&) {
    return {}; // SMB has no such call
}

} // namespace axiscal
