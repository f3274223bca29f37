#pragma once
// libsmbclient behind names of its own: a context and a file of it, both closed at the end. For one
// thread. Calls return what the library returns and leave errno as it set it.

#include "acquisition/publish/smb/smb_destination.hpp"

#include <libsmbclient.h>

namespace axiscal {

class SmbDestination::Session {
public:
    /// Says nothing to the server yet. Without context: errno tells why.
    Session(ShareAccount account, const SmbSettings& settings);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
    explicit operator bool() const { return context_ != nullptr; }

    [[nodiscard]] SMBCCTX* context() const { return context_; }
    [[nodiscard]] const ShareAccount& account() const { return account_; }

private:
    static void give_account(SMBCCTX* context,
                             const char* server,
                             const char* share,
                             char* domain,
                             int domain_size,
                             char* user,
                             int user_size,
                             char* password,
                             int password_size);
    ShareAccount account_;
    SMBCCTX* context_ = nullptr;
};

/// An open file of the share.
class SmbFile {
public:
    SmbFile(SMBCCTX* context, const std::string& url, int flags)
        : context_{context}
        , file_{smbc_getFunctionOpen(context)(context, url.c_str(), flags, file_mode)} {}
    ~SmbFile() {
        if (file_) smbc_getFunctionClose(context_)(context_, file_);
    }
    SmbFile(const SmbFile&) = delete;
    SmbFile& operator=(const SmbFile&) = delete;
    explicit operator bool() const { return file_ != nullptr; }
    ssize_t write(const char* bytes, std::size_t size) {
        return smbc_getFunctionWrite(context_)(context_, file_, bytes, size);
    }
    ssize_t read(char* bytes, std::size_t size) {
        return smbc_getFunctionRead(context_)(context_, file_, bytes, size);
    }
    bool rewind() { return smbc_getFunctionLseek(context_)(context_, file_, 0, SEEK_SET) == 0; }
    /// A server reports a failed write here at the latest.
    bool close() {
        SMBCFILE* const file = std::exchange(file_, nullptr);
        return smbc_getFunctionClose(context_)(context_, file) == 0;
    }

private:
    static constexpr mode_t file_mode = 0664; // before the server's own mask
    SMBCCTX* context_;
    SMBCFILE* file_;
};

} // namespace axiscal
