#include "acquisition/console/http_page.hpp"

#include <string>

namespace axiscal {
namespace {

namespace page_http = boost::beast::http;

/// no-cache: kept, but asked for each time, so that a page is never older than its daemon.
void set_page_fields(HttpResponse& response, const PageFile& file) {
    response.set(page_http::field::etag, file.etag);
    response.set(page_http::field::cache_control, "no-cache");
    response.set("Content-Security-Policy", {page_policy.data(), page_policy.size()});
    response.set("X-Content-Type-Options", "nosniff");
    response.set("X-Frame-Options", "DENY");
    response.set("Referrer-Policy", "no-referrer");
    response.set("Cross-Origin-Resource-Policy", "same-origin");
    response.set("Cross-Origin-Opener-Policy", "same-origin");
}

} // namespace

bool is_page_path(std::string_view path) {
    return path == "/" || path.starts_with("/page/");
}

HttpResponse answer_page(const HttpRequest& request, const PageFiles& page, std::string_view path) {
    const PageFile* const file = page.find(path);
    if (!file)
        return answer_in_words(request, page_http::status::not_found,
                               page.count() == 0
                                   ? "the page is not installed on this station; the command line "
                                     "shows the same: axiscal status"
                                   : "the page has no file of this name; it begins at /");
    const auto has = request.find(page_http::field::if_none_match);
    const bool unchanged =
        has != request.end() && names_etag({has->value().data(), has->value().size()}, file->etag);
    HttpResponse response{unchanged ? page_http::status::not_modified : page_http::status::ok,
                          request.version()};
    set_page_fields(response, *file);
    response.set(page_http::field::content_type, file->type);
    response.keep_alive(request.keep_alive());
    if (!unchanged) response.body() = file->bytes;
    response.prepare_payload();
    return response;
}

} // namespace axiscal
