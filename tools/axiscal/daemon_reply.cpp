#include "tools/axiscal/daemon_reply.hpp"

namespace axiscal {

int tell_no_contact(const Error& error) {
    std::cerr << error.detail << (error.cause ? " (" + error.cause.message() + ")" : "") << "\n";
    return error.fault == Fault::bad_request ? exit_usage : exit_no_contact;
}

int tell_refusal(const Reply& reply) {
    const auto body = nlohmann::ordered_json::parse(reply.body, nullptr, false);
    const bool known = body.is_object() && body.contains("error");
    std::cerr << (known ? body["error"].value("sentence", "")
                        : "the station answered " + std::to_string(reply.status))
              << "\n";
    return exit_forbidden;
}

} // namespace axiscal
