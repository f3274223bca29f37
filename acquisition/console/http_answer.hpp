#pragma once
// Between the bytes of HTTP and access.hpp: the head that is judged, and the answer. Pure. Beast is
// heavy: of the daemon only http_answer.cpp and http_server.cpp include this.

#include "acquisition/console/access.hpp"
#include "analysis/quantity/result.hpp"

#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace axiscal {

using HttpRequest = boost::beast::http::request<boost::beast::http::string_body>;
using HttpResponse = boost::beast::http::response<boost::beast::http::string_body>;

/// What access is judged by. A client's bytes enter here: host and origin become valid text.
RequestHead head_of(const HttpRequest& request, Door door);

HttpResponse answer(const HttpRequest& request,
                    boost::beast::http::status status,
                    const nlohmann::ordered_json& body);
HttpResponse answer(const HttpRequest& request, const Error& error);
/// 200 with what is no JSON. @param type  of the content
HttpResponse answer_as(const HttpRequest& request, std::string_view type, std::string text);
/// `sentence` under the name of the fault that belongs to `status`.
HttpResponse answer_in_words(const HttpRequest& request,
                             boost::beast::http::status status,
                             const std::string& sentence);

} // namespace axiscal
