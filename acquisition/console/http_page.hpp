#pragma once
// The page's files as answers of HTTP. Beast is heavy: of the daemon only the files http_*.cpp
// include this.

#include "acquisition/console/http_answer.hpp"
#include "acquisition/console/page_files.hpp"

#include <string_view>

namespace axiscal {

/// What a browser may do with the page: load scripts, styles and data from the station itself, and
/// nothing from anywhere else (Content-Security-Policy, level 3).
inline constexpr std::string_view page_policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Whether GET of it is answered by answer_page(): "/", and what stands below "/page/".
bool is_page_path(std::string_view path);

/// 200 with the file, 304 where the client has it, 404 with the reason. Packed by gzip where the
/// client takes that and the file was packed; each form has a tag of its own.
/// @param path  of the request, without query
HttpResponse answer_page(const HttpRequest& request, const PageFiles& page, std::string_view path);

} // namespace axiscal
