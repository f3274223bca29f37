#pragma once
// What every command does with an answer of axiscald.

#include "tools/axiscal/exit_code.hpp"
#include "tools/axiscal/station_client.hpp"

#include <nlohmann/json.hpp>

#include <iostream>

namespace axiscal {

/// Said on standard error. @returns exit_no_contact, of an address that is none exit_usage.
int tell_no_contact(const Error& error);
/// Prints the station's own sentence for a refused call. @returns exit_forbidden.
int tell_refusal(const Reply& reply);

/// Prints the answer, or what went wrong, and turns it into an exit code.
template <class Show> int show_reply(const Result<Reply>& reply, bool json, Show show) {
    if (!reply) return tell_no_contact(reply.error());
    if (reply->status >= 300) return tell_refusal(*reply);
    if (json) return std::cout << reply->body << std::flush, exit_ok;
    std::cout << show(nlohmann::ordered_json::parse(reply->body)) << std::flush;
    return exit_ok;
}

} // namespace axiscal
