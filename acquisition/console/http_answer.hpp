#pragma once
// Between the bytes of HTTP and access.hpp: the head that is judged, and the answer. Pure. Beast is
// heavy: of the daemon only the files http_*.cpp include this.

#include "acquisition/console/access.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/run_revisions.hpp"

#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

using HttpRequest = boost::beast::http::request<boost::beast::http::string_body>;
using HttpResponse = boost::beast::http::response<boost::beast::http::string_body>;

/// What is asked for, without what a page may hang behind it ("?x=1", "/").
std::string asked_path(const HttpRequest& request);
/// As it came; empty where there is none.
std::string last_event_id_of(const HttpRequest& request);

/// What access is judged by. A client's bytes enter here: host and origin become valid text. Which
/// browser the cookies prove is not known here.
RequestHead head_of(const HttpRequest& request, Door door);

HttpResponse answer(const HttpRequest& request,
                    boost::beast::http::status status,
                    const nlohmann::ordered_json& body);
HttpResponse answer(const HttpRequest& request, const Error& error);
/// Arming met checks that do not hold: all of them at once.
HttpResponse answer_with_checks(const HttpRequest& request,
                                const Error& error,
                                const Result<std::vector<PreflightRecord>>& checks);
/// 200 with what is no JSON. @param type  of the content
HttpResponse answer_as(const HttpRequest& request, std::string_view type, std::string text);
/// `sentence` under the name of the fault that belongs to `status`.
HttpResponse answer_in_words(const HttpRequest& request,
                             boost::beast::http::status status,
                             const std::string& sentence);

} // namespace axiscal
