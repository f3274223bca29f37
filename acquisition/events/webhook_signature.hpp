#pragma once
// How a receiver knows that a POST is the station's: the scheme of Standard Webhooks 1.0.0
// (standardwebhooks.com), its symmetric part "v1".

#include "analysis/quantity/result.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

using WebhookKey = std::string; ///< bytes

/// "whsec_" and base64 of 24 to 64 bytes, one a line; of two both sign, so that a receiver can
/// change from one to the other. Blank lines and those that begin with # are passed over. Pure.
/// @param name  of the file, for errors @errors Fault::bad_configuration naming file and line,
/// never what stands there.
Result<std::vector<WebhookKey>> parse_webhook_secret(const std::string& text,
                                                     const std::string& name);

/// From a plain file of this user or root, with no right for group and others.
/// @errors Fault::refused for wider rights; Fault::bad_configuration; Fault::io.
Result<std::vector<WebhookKey>> read_webhook_secret(const std::string& file);

/// "v1,BASE64 v1,BASE64": HMAC-SHA256 of "id.seconds.body" by each key. Pure.
std::string webhook_signatures(const std::vector<WebhookKey>& keys,
                               const std::string& id,
                               std::int64_t utc_s,
                               std::string_view body);

} // namespace axiscal
