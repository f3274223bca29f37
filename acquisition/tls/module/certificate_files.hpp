#pragma once
// From two PEM files to what OpenSSL serves with, or to the sentences that say why not.

#include "acquisition/tls/tls_interface.hpp"

#include <boost/asio/ssl/context.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace axiscal::tls {

struct LoadedCertificate {
    /// TLS 1.2 and newer. Null: a finding refuses.
    std::shared_ptr<boost::asio::ssl::context> context;
    std::vector<TlsFinding> findings;
};
/// @param utc_s  when "now" is, for validity
LoadedCertificate load_certificate(const TlsFiles& files, std::int64_t utc_s);

/// Differs as soon as one of the files was written or replaced, also behind a link. Never fails.
std::string files_mark(const TlsFiles& files);

} // namespace axiscal::tls
