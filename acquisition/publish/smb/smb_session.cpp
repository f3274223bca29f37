#include "acquisition/publish/smb/smb_session.hpp"

#include <algorithm>
#include <cstring>
extern "C" {
#include <tevent.h> // says nothing of C++ itself
}
#include <sys/mman.h>
#include <unistd.h>

namespace axiscal {
namespace {

// The library's own settings, whatever /etc/samba/smb.conf of this PC says: no SMB 1, no browsing,
// names by the resolver alone, signed where not encrypted.
constexpr std::string_view rules = "[global]\n"
                                   "client min protocol = SMB2_10\n"
                                   "client max protocol = SMB3_11\n"
                                   "client signing = required\n"
                                   "client ipc signing = required\n"
                                   "client ipc min protocol = SMB2_10\n"
                                   "client use kerberos = off\n"
                                   "client lanman auth = no\n"
                                   "client plaintext auth = no\n"
                                   "client ntlmv2 auth = yes\n"
                                   "disable netbios = yes\n"
                                   "name resolve order = host\n"
                                   "log level = 0\n";

/// The library takes its settings from a file only; this one lives in memory.
bool apply_rules(SMBCCTX* context, bool require_encryption) {
    const std::string text = std::string{rules} + "client smb encrypt = " +
                             (require_encryption ? "required\n" : "desired\n");
    const int file = ::memfd_create("axiscal-smb", MFD_CLOEXEC);
    if (file < 0) return false;
    const bool written =
        ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    const std::string path = "/proc/self/fd/" + std::to_string(file);
    const bool taken = written && smbc_setConfiguration(context, path.c_str()) == 0;
    ::close(file);
    return taken;
}

void put(const std::string& text, char* to, int size) {
    if (size <= 0) return;
    const auto length = std::min(text.size(), static_cast<std::size_t>(size) - 1);
    std::memcpy(to, text.data(), length);
    to[length] = '\0';
}

} // namespace

SmbDestination::Session::Session(ShareAccount account, const SmbSettings& settings)
    : account_{std::move(account)} {
    // A loop a request is what the library makes; this kind costs it nothing to make.
    tevent_set_default_backend("poll");
    SMBCCTX* const context = smbc_new_context();
    if (!context) return;
    smbc_setDebug(context, 0);
    smbc_setOptionDebugToStderr(context, 1);
    smbc_setOptionUserData(context, this);
    smbc_setFunctionAuthDataWithContext(context, give_account);
    // The library finds its session again by these two: with others than the account's it would
    // open a new one with each call.
    smbc_setUser(context, account_.user.c_str());
    if (!account_.domain.empty()) smbc_setWorkgroup(context, account_.domain.c_str());
    smbc_setOptionNoAutoAnonymousLogin(context, 1);
    smbc_setOptionUseKerberos(context, 0);
    smbc_setPort(context, static_cast<std::uint16_t>(settings.address.port));
    smbc_setTimeout(
        context,
        static_cast<int>(
            std::chrono::duration_cast<std::chrono::milliseconds>(settings.timeout).count()));
    const bool require = settings.require_encryption;
    smbc_setOptionSmbEncryptionLevel(context, require ? SMBC_ENCRYPTLEVEL_REQUIRE
                                                      : SMBC_ENCRYPTLEVEL_REQUEST);
    if (!smbc_init_context(context) || !apply_rules(context, require) ||
        !smbc_setOptionProtocols(context, require ? "SMB3_00" : "SMB2_10", "SMB3_11")) {
        smbc_free_context(context, 1);
        return;
    }
    context_ = context;
}

SmbDestination::Session::~Session() {
    if (context_) smbc_free_context(context_, 1);
}

void SmbDestination::Session::give_account(SMBCCTX* context,
                                           const char*,
                                           const char*,
                                           char* domain,
                                           int domain_size,
                                           char* user,
                                           int user_size,
                                           char* password,
                                           int password_size) {
    const auto* session = static_cast<const Session*>(smbc_getOptionUserData(context));
    if (!session->account_.domain.empty()) put(session->account_.domain, domain, domain_size);
    put(session->account_.user, user, user_size);
    put(session->account_.password, password, password_size);
}

std::string smb_library_name() {
    return std::string{"libsmbclient "} + smbc_version();
}

} // namespace axiscal
