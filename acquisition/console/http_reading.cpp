#include "acquisition/console/http_reading.hpp"

#include <algorithm>

namespace axiscal {
namespace {

namespace http = boost::beast::http;

/// tchar of RFC 9110, 5.6.2: what methods are made of.
bool is_of_method(char letter) {
    constexpr std::string_view marks = "!#$%&'*+-.^_`|~";
    return (letter >= 'A' && letter <= 'Z') || (letter >= 'a' && letter <= 'z') ||
           (letter >= '0' && letter <= '9') || marks.find(letter) != std::string_view::npos;
}

} // namespace

Beginning judge_beginning(std::string_view bytes) {
    // The parser has the word on what is too long for a line.
    const Beginning unfinished =
        bytes.size() < head_limit ? Beginning::too_short : Beginning::request_line;
    const auto space = std::ranges::find_if_not(bytes, is_of_method);
    if (space == bytes.end()) return unfinished;
    if (*space != ' ' || space == bytes.begin()) return Beginning::none;
    const std::size_t end = bytes.find('\n');
    if (end == std::string_view::npos) return unfinished;
    return bytes.substr(0, end).find(" HTTP/1.") != std::string_view::npos
               ? Beginning::request_line
               : Beginning::none;
}

HttpResponse refuse_request(http::status status, const std::string& sentence) {
    HttpRequest unread;
    unread.version(11);
    unread.keep_alive(false);
    return answer_in_words(unread, status, sentence);
}

std::optional<HttpResponse> refusal_of(const boost::system::error_code& error) {
    if (error == http::error::body_limit)
        return refuse_request(http::status::payload_too_large,
                              "a request has at most " + std::to_string(body_limit / 1024) +
                                  " KiB of body");
    if (error == http::error::header_limit || error == http::error::buffer_overflow)
        return refuse_request(http::status::request_header_fields_too_large,
                              "the head of a request has at most " +
                                  std::to_string(head_limit / 1024) + " KiB");
    static const boost::system::error_code one_of_http = http::error::bad_method;
    if (error == http::error::end_of_stream || error.category() != one_of_http.category())
        return std::nullopt;
    return refuse_request(http::status::bad_request,
                          "this is no HTTP/1.1 request (" + error.message() + ")");
}

} // namespace axiscal
