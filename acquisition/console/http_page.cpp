#include "acquisition/console/http_page.hpp"

#include "acquisition/console/accepted_encoding.hpp"

#include <string>

namespace axiscal {
namespace {

namespace page_http = boost::beast::http;

/// no-cache: kept, but asked for each time, so that a page is never older than its daemon.
void set_page_fields(HttpResponse& response, const std::string& etag) {
    response.set(page_http::field::etag, etag);
    response.set(page_http::field::cache_control, "no-cache");
    response.set(page_http::field::vary, "Accept-Encoding");
    response.set("Content-Security-Policy", {page_policy.data(), page_policy.size()});
    response.set("X-Content-Type-Options", "nosniff");
    response.set("X-Frame-Options", "DENY");
    response.set("Referrer-Policy", "no-referrer");
    response.set("Cross-Origin-Resource-Policy", "same-origin");
    response.set("Cross-Origin-Opener-Policy", "same-origin");
}

/// Lines of one name are one list (RFC 9110, 5.3).
std::string accepted_encodings_of(const HttpRequest& request) {
    std::string list;
    const auto [first, last] = request.equal_range(page_http::field::accept_encoding);
    for (auto line = first; line != last; ++line) {
        if (!list.empty()) list += ", ";
        list.append(line->value().data(), line->value().size());
    }
    return list;
}

bool has_form(const HttpRequest& request, std::string_view etag) {
    const auto has = request.find(page_http::field::if_none_match);
    return has != request.end() && names_etag({has->value().data(), has->value().size()}, etag);
}

HttpResponse answer_file(const HttpRequest& request, const PageFile& file) {
    const bool packed = !file.packed.empty() && takes_gzip(accepted_encodings_of(request));
    const std::string& etag = packed ? file.packed_etag : file.etag;
    const bool unchanged = has_form(request, etag);
    HttpResponse response{unchanged ? page_http::status::not_modified : page_http::status::ok,
                          request.version()};
    set_page_fields(response, etag);
    response.set(page_http::field::content_type, file.type);
    response.keep_alive(request.keep_alive());
    if (!unchanged) {
        if (packed) response.set(page_http::field::content_encoding, "gzip");
        response.body() = packed ? file.packed : file.bytes();
    }
    response.prepare_payload();
    return response;
}

} // namespace

bool is_page_path(std::string_view path) {
    return path == "/" || path.starts_with("/page/");
}

HttpResponse answer_page(const HttpRequest& request, const PageFiles& page, std::string_view path) {
    if (const PageFile* const file = page.find(path)) return answer_file(request, *file);
    return answer_in_words(request, page_http::status::not_found,
                           page.count() == 0
                               ? "the page is not installed on this station; the command line "
                                 "shows the same: axiscal status"
                               : "the page has no file of this name; it begins at /");
}

} // namespace axiscal
