#include "acquisition/console/http_answer.hpp"

#include "acquisition/console/api_json.hpp"
#include "analysis/quantity/valid_text.hpp"
#include "config/json_text.hpp"

#include <utility>

namespace axiscal {
namespace {

namespace http = boost::beast::http;

http::status status_of(Fault fault) {
    switch (fault) {
    case Fault::bad_request:
    case Fault::bad_configuration: return http::status::bad_request;
    case Fault::not_found: return http::status::not_found;
    case Fault::refused: return http::status::forbidden;
    case Fault::internal:
    case Fault::io:
    case Fault::not_durable: return http::status::internal_server_error;
    default: return http::status::conflict;
    }
}

const char* fault_of(http::status status) {
    switch (status) {
    case http::status::not_found:
    case http::status::method_not_allowed: return "not_found";
    case http::status::internal_server_error: return "internal";
    case http::status::service_unavailable: return "busy";
    case http::status::bad_request:
    case http::status::payload_too_large:
    case http::status::expectation_failed:
    case http::status::request_header_fields_too_large: return "bad_request";
    default: return "refused";
    }
}

std::string field(const HttpRequest& request, http::field name) {
    const auto found = request.find(name);
    return found == request.end() ? std::string{} : std::string{found->value()};
}

Matter matter_of(const HttpRequest& request) {
    const std::string path = asked_path(request);
    if (path == pair_path || path == pair_end_path) return Matter::pairing;
    if (path == session_path && request.method() == http::verb::post)
        return Matter::opening_session;
    return Matter::station;
}

HttpResponse answer_of(const HttpRequest& request,
                       http::status status,
                       std::string_view type,
                       std::string text) {
    HttpResponse response{status, request.version()};
    response.set(http::field::content_type, {type.data(), type.size()});
    response.set(http::field::cache_control, "no-store");
    response.set("X-Content-Type-Options", "nosniff");
    response.keep_alive(request.keep_alive());
    response.body() = std::move(text);
    response.prepare_payload();
    return response;
}

} // namespace

std::string asked_path(const HttpRequest& request) {
    std::string_view path{request.target().data(), request.target().size()};
    path = path.substr(0, path.find('?'));
    while (path.size() > 1 && path.ends_with('/'))
        path.remove_suffix(1);
    return std::string{path};
}

std::string last_event_id_of(const HttpRequest& request) {
    const auto found = request.find("Last-Event-ID");
    return found == request.end() ? std::string{} : std::string{found->value()};
}

RequestHead head_of(const HttpRequest& request, Door door) {
    RequestHead head;
    head.door = door;
    head.changes_state =
        request.method() != http::verb::get && request.method() != http::verb::head;
    head.matter = matter_of(request);
    head.host = valid_text(field(request, http::field::host));
    head.origin = valid_text(field(request, http::field::origin));
    head.authorization = field(request, http::field::authorization); // compared, never shown
    head.cookies = field(request, http::field::cookie);              // the same
    return head;
}

HttpResponse
answer(const HttpRequest& request, http::status status, const nlohmann::ordered_json& body) {
    return answer_of(request, status, "application/json; charset=utf-8", json_text(body) + "\n");
}

HttpResponse answer_as(const HttpRequest& request, std::string_view type, std::string text) {
    return answer_of(request, http::status::ok, type, std::move(text));
}

HttpResponse answer(const HttpRequest& request, const Error& error) {
    return answer(request, status_of(error.fault), to_json(error));
}

HttpResponse answer_with_checks(const HttpRequest& request,
                                const Error& error,
                                const Result<std::vector<PreflightRecord>>& checks) {
    auto body = to_json(error);
    if (checks) body["checks"] = to_json(*checks);
    return answer(request, http::status::conflict, body);
}

HttpResponse
answer_in_words(const HttpRequest& request, http::status status, const std::string& sentence) {
    return answer(request, status,
                  {{"error", {{"fault", fault_of(status)}, {"sentence", sentence}}}});
}

} // namespace axiscal
