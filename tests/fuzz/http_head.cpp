// Heads of HTTP requests as anybody may send them: read by Beast, judged, answered.

#include "acquisition/console/accepted_encoding.hpp"
#include "acquisition/console/access.hpp"
#include "acquisition/console/event_stream.hpp"
#include "acquisition/console/http_answer.hpp"
#include "acquisition/console/http_reading.hpp"
#include "acquisition/console/runs_query.hpp"
#include "acquisition/console/session_cookie.hpp"
#include "acquisition/console/stream_json.hpp"
#include "tests/fuzz/judge.hpp"

#include <boost/beast/http.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <string_view>

using namespace axiscal;
namespace http = boost::beast::http;

namespace {

const std::string token(64, 't');

/// Whether it stands in a text, whatever its case.
bool has_word(std::string_view text, std::string_view word) {
    for (; text.size() >= word.size(); text.remove_prefix(1))
        if (boost::beast::iequals(text.substr(0, word.size()), word)) return true;
    return false;
}

/// Packed gets who named it, and never who refuses it, wherever that stands.
void judge_encodings(const HttpRequest& request) {
    const auto [first, last] = request.equal_range(http::field::accept_encoding);
    for (auto line = first; line != last; ++line) {
        const std::string accepts{line->value()};
        fuzz::require(!takes_gzip(accepts) || has_word(accepts, "gzip") || has_word(accepts, "*"),
                      "packed is sent to who named it");
        for (const std::string& refused : {accepts + ", gzip;q=0", "gzip;q=0, " + accepts})
            fuzz::require(!takes_gzip(refused), "a refusal stays one");
    }
}

/// What was sent is shown in the answer: text that everybody's JSON reader takes.
void judge_answer(const HttpResponse& response) {
    const auto body = nlohmann::json::parse(response.body(), nullptr, false);
    fuzz::require(!body.is_discarded(), "every answer is JSON");
    fuzz::require(!body.at("error").at("sentence").get<std::string>().empty(),
                  "a refusal has its sentence");
    for (const auto& field : response)
        fuzz::require(field.value().find_first_of("\r\n") == boost::beast::string_view::npos,
                      "no header line holds another");
}

/// As RFC 9110 compares them, 4.2.3 and 11.1: in any case, with a dot behind or without.
bool is_of_station(std::string_view host) {
    for (const std::string name : {"localhost:8470", "localhost.:8470"})
        if (boost::beast::iequals(host, name)) return true;
    for (const std::string name : {"localhost", "bay3.plant.example"})
        if (boost::beast::iequals(host, name) || boost::beast::iequals(host, name + "."))
            return true;
    return false;
}

bool bears_token(std::string_view authorization) {
    constexpr std::string_view scheme = "Bearer ";
    if (!boost::beast::iequals(authorization.substr(0, scheme.size()), scheme)) return false;
    authorization.remove_prefix(scheme.size());
    authorization.remove_prefix(
        std::min(authorization.find_first_not_of(' '), authorization.size()));
    return authorization == token;
}

/// A paired browser, or one that bears a code, on a page of the station at its own port.
bool comes_from_page(const RequestHead& head) {
    const bool known = !head.page.empty() || head.matter == Matter::opening_session;
    return known && (boost::beast::iequals(head.origin, "http://localhost:8470") ||
                     boost::beast::iequals(head.origin, "https://localhost:8470") ||
                     boost::beast::iequals(head.origin, "http://localhost.:8470") ||
                     boost::beast::iequals(head.origin, "https://localhost.:8470"));
}

void judge_verdict(const HttpRequest& request, const RequestHead& head, const AccessRules& rules) {
    const AccessVerdict verdict = judge_access(head, rules);
    if (verdict.status == 200) {
        fuzz::require(!head.changes_state || head.door == Door::unix_socket ||
                          bears_token(head.authorization) || comes_from_page(head),
                      "over TCP only the token and paired pages change the station");
        fuzz::require(head.matter != Matter::pairing || head.door == Door::unix_socket,
                      "over TCP nobody pairs");
        fuzz::require(head.door == Door::unix_socket || is_of_station(head.host),
                      "over TCP only names of the station are answered");
        return;
    }
    judge_answer(
        answer_in_words(request, static_cast<http::status>(verdict.status), verdict.sentence));
}

void judge_events(const HttpRequest& request) {
    const std::string last = last_event_id_of(request);
    const auto asked = events_asked_of({request.target().data(), request.target().size()}, last);
    if (!asked) return judge_answer(answer(request, asked.error()));
    fuzz::require(asked->stream_points <= 4096, "a stream is thinned to what a screen holds");
    if (asked->has)
        fuzz::require(points_id_of(text_of(*asked->has)) == asked->has, "an id is read as written");
    const std::string event = event_text("points", last, last);
    fuzz::require(event.find("\n\n") == event.size() - 2, "one event stays one event");
}

/// A name out of a path is looked for among names: none of them leads out of a folder.
void judge_runs(const HttpRequest& request) {
    const std::string path = asked_path(request);
    const RunNamed named = run_named_in(path);
    for (const std::string& name : {named.id, named.paper})
        fuzz::require(name.empty() || (name.front() != '.' &&
                                       name.find_first_of("/\\%\"\r\n") == std::string::npos),
                      "what a path names is a plain name");
    fuzz::require(runs_call_of(path) != run_paper_path || !named.paper.empty(),
                  "a paper is asked for by its name");
    const auto asked = runs_asked_of({request.target().data(), request.target().size()});
    if (!asked) return judge_answer(answer(request, asked.error()));
    fuzz::require(asked->limit >= 1 && asked->limit <= 100, "a page has 1 to 100 rows");
    fuzz::require(asked->before.empty() || is_run_name(asked->before), "before is a run");
    fuzz::require(asked->text.size() <= 3 * 200, "a search is short");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes = fuzz::as_text(data, size);
    http::request_parser<http::string_body> parser;
    parser.eager(true);
    boost::beast::error_code error;
    static_cast<void>(parser.put(boost::asio::buffer(bytes.data(), bytes.size()), error));
    if (!parser.is_header_done()) return 0;
    fuzz::require(judge_beginning(bytes) == Beginning::request_line,
                  "what the parser takes is not turned away before it");
    const HttpRequest& request = parser.get();
    const AccessRules rules{
        {"localhost", "bay3.plant.example", "localhost:8470"}, token, {"localhost:8470"}};
    for (const Door door : {Door::tcp, Door::unix_socket}) {
        RequestHead head = head_of(request, door);
        judge_verdict(request, head, rules);
        if (!token_in_cookies(head.cookies).empty()) head.page = "tablet 2"; // as if it were paired
        judge_verdict(request, head, rules);
    }
    judge_encodings(request);
    judge_events(request);
    judge_runs(request);
    const auto points = stream_points_of({request.target().data(), request.target().size()});
    if (points) {
        fuzz::require(*points >= 1 && *points <= 4096,
                      "a stream is thinned to what a screen holds");
    } else {
        judge_answer(answer(request, points.error()));
    }
    return 0;
}
