#pragma once
// "https://alarms.shop.example/axiscal" as a person writes it in the station file. No error quotes
// it: a path may be a secret, too. Pure.

#include "analysis/quantity/result.hpp"

#include <string>
#include <string_view>

namespace axiscal {

struct WebhookAddress {
    bool encrypted = true; ///< https
    std::string host;      ///< name or address, without brackets
    int port = 443;
    std::string place; ///< "https://host:8443", without its path: what a log may hold
};

/// Of "http" and "https" alone; without an account, a fragment, blanks and signs beyond ASCII.
/// "http" only to this PC or a private address in digits: a name may lead anywhere tomorrow.
/// @errors Fault::bad_request saying what would be right.
Result<WebhookAddress> parse_webhook_address(std::string_view url);

/// This PC by its name, or an address of it or of a private network in digits.
bool is_private_host(const std::string& host);

} // namespace axiscal
