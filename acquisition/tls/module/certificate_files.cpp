#include "acquisition/tls/module/certificate_files.hpp"

#include <boost/asio/buffer.hpp>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <ctime>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace axiscal::tls {
namespace {

namespace ssl = boost::asio::ssl;

constexpr std::size_t most_bytes = 256 * 1024; // a chain has some 10 KiB

struct PemFile {
    std::string text;
    unsigned mode = 0;
    std::string complaint; ///< empty: it was read
};

std::string unreadable(const std::string& path, int error) {
    const std::string word = std::generic_category().message(error);
    if (error == ENOENT || error == ENOTDIR) return path + " is not there (" + word + ")";
    return path + " cannot be read (" + word +
           "): the user whom axiscald runs as must read it and enter its folder";
}

/// Bounded, and never waits for a pipe: O_NONBLOCK, and files alone.
PemFile read_pem(const std::string& path) {
    PemFile pem;
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    struct stat found {};
    if (file < 0 || ::fstat(file, &found) != 0) {
        pem.complaint = unreadable(path, errno);
    } else if (!S_ISREG(found.st_mode)) {
        pem.complaint = path + " is no file";
    } else {
        pem.mode = found.st_mode;
        pem.text.resize(most_bytes);
        const ssize_t got = ::read(file, pem.text.data(), pem.text.size());
        if (got < 0) pem.complaint = unreadable(path, errno);
        pem.text.resize(got < 0 ? 0 : static_cast<std::size_t>(got));
    }
    if (file >= 0) ::close(file);
    return pem;
}

void refuse(LoadedCertificate& loaded, bool of_key, std::string sentence) {
    loaded.findings.push_back({of_key, true, std::move(sentence)});
    loaded.context = nullptr;
}

void note(LoadedCertificate& loaded, bool of_key, std::string sentence) {
    loaded.findings.push_back({of_key, false, std::move(sentence)});
}

/// No tickets and no sessions to be resumed: their keys would live as long as the daemon, months,
/// and a handshake is cheap. Of TLS 1.2 only what keeps yesterday's traffic shut when the key is
/// lost tomorrow.
std::shared_ptr<ssl::context> strict_context() {
    auto context = std::make_shared<ssl::context>(ssl::context::tls_server);
    SSL_CTX* const raw = context->native_handle();
    SSL_CTX_set_min_proto_version(raw, TLS1_2_VERSION);
    SSL_CTX_set_options(raw, SSL_OP_NO_COMPRESSION | SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_TICKET);
    SSL_CTX_set_num_tickets(raw, 0);
    SSL_CTX_set_session_cache_mode(raw, SSL_SESS_CACHE_OFF);
    SSL_CTX_set_cipher_list(raw, "ECDHE+AESGCM:ECDHE+CHACHA20");
    // Without this OpenSSL asks at the terminal.
    boost::system::error_code ignored;
    context->set_password_callback([](std::size_t, ssl::context::password_purpose) { return ""; },
                                   ignored);
    return context;
}

/// "2027-11-21", the day in UTC.
std::string day_of(const ASN1_TIME* time) {
    std::tm parts{};
    if (ASN1_TIME_to_tm(time, &parts) != 1) return "a day that cannot be read";
    std::array<char, 32> text{};
    const auto length = std::strftime(text.data(), text.size(), "%Y-%m-%d", &parts);
    return {text.data(), length};
}

/// A station whose certificate has run out is still better shown with a browser's warning than not
/// at all.
void note_validity(LoadedCertificate& loaded, const X509* own, std::int64_t utc_s) {
    auto now = static_cast<std::time_t>(utc_s);
    const ASN1_TIME* const begin = X509_get0_notBefore(own);
    const ASN1_TIME* const end = X509_get0_notAfter(own);
    if (X509_cmp_time(end, &now) < 0)
        note(loaded, false,
             "has ended on " + day_of(end) +
                 ": browsers warn before they show the station; put "
                 "a new one there");
    if (X509_cmp_time(begin, &now) > 0)
        note(loaded, false,
             "begins only on " + day_of(begin) +
                 ": browsers warn until then; is the computer's "
                 "calendar right?");
    if (X509_get_ext_by_NID(own, NID_subject_alt_name, -1) < 0)
        note(loaded, false,
             "names no computer (subjectAltName): no browser of today takes it as that of the "
             "station");
}

bool take_certificate(LoadedCertificate& loaded, const std::string& path, const PemFile& pem) {
    boost::system::error_code error;
    loaded.context->use_certificate_chain(boost::asio::buffer(pem.text), error);
    if (error)
        refuse(loaded, false,
               path + " holds no certificate that can be used (" + error.message() +
                   "): wanted is PEM, \"-----BEGIN CERTIFICATE-----\", the station's own first");
    return !error;
}

std::string why_no_key(const std::string& path, const PemFile& pem, const std::string& word) {
    if (pem.text.find("ENCRYPTED") != std::string::npos)
        return path + " is locked by a pass phrase, and a service has nobody to ask: openssl pkey "
                      "-in LOCKED -out KEY writes it without one";
    if (pem.text.find("PRIVATE KEY-----") == std::string::npos)
        return path + " holds no private key: wanted is PEM, \"-----BEGIN PRIVATE KEY-----\"";
    return path + " cannot be used (" + word + ")";
}

/// OpenSSL compares while it takes a key, but only where both are of one kind.
void take_key(LoadedCertificate& loaded, const TlsFiles& files, const PemFile& pem) {
    boost::system::error_code error;
    loaded.context->use_private_key(boost::asio::buffer(pem.text), ssl::context::pem, error);
    const bool other_values = error && ERR_GET_REASON(static_cast<unsigned long>(error.value())) ==
                                           X509_R_KEY_VALUES_MISMATCH;
    if (error && !other_values) {
        refuse(loaded, true, why_no_key(files.key, pem, error.message()));
        return;
    }
    if (other_values || SSL_CTX_check_private_key(loaded.context->native_handle()) != 1)
        refuse(loaded, true,
               files.key + " does not belong to the first certificate of " + files.certificate +
                   ": name the pair that was made together, the station's own certificate before "
                   "those of the CA");
    ERR_clear_error();
}

} // namespace

LoadedCertificate load_certificate(const TlsFiles& files, std::int64_t utc_s) {
    LoadedCertificate loaded{strict_context(), {}};
    const PemFile certificate = read_pem(files.certificate), key = read_pem(files.key);
    if (!certificate.complaint.empty()) refuse(loaded, false, certificate.complaint);
    if (!key.complaint.empty()) refuse(loaded, true, key.complaint);
    if (!loaded.context || !take_certificate(loaded, files.certificate, certificate)) return loaded;
    take_key(loaded, files, key);
    if (!loaded.context) return loaded;
    note_validity(loaded, SSL_CTX_get0_certificate(loaded.context->native_handle()), utc_s);
    if ((key.mode & S_IRWXO) != 0)
        note(loaded, true,
             files.key + " can be reached by everybody here: sudo chmod o= " + files.key);
    return loaded;
}

std::string files_mark(const TlsFiles& files) {
    std::string mark;
    for (const std::string* const path : {&files.certificate, &files.key}) {
        struct stat found {};
        if (::stat(path->c_str(), &found) != 0) found = {};
        for (const auto part :
             {static_cast<long long>(found.st_ino), static_cast<long long>(found.st_size),
              static_cast<long long>(found.st_mtim.tv_sec),
              static_cast<long long>(found.st_mtim.tv_nsec)})
            mark += std::to_string(part) + " ";
    }
    return mark;
}

} // namespace axiscal::tls
