#include "acquisition/console/event_stream.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace axiscal {
namespace {

constexpr std::size_t most_stretches = 4096; // as of GET /v1/stream

/// A whole number that is all of `digits`.
template <class Number> std::optional<Number> whole_number(std::string_view digits, int base = 10) {
    Number number = 0;
    const char* end = digits.data() + digits.size();
    const auto [rest, error] = std::from_chars(digits.data(), end, number, base);
    if (error != std::errc{} || rest != end) return std::nullopt;
    return number;
}

/// What stands before the next `mark`, which is cut off; all of it where there is none.
std::string_view cut_at(char mark, std::string_view& text) {
    const std::size_t end = std::min(text.find(mark), text.size());
    const std::string_view part = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return part;
}

void add_field(std::string& text, std::string_view field, std::string_view value) {
    text += field;
    text += ": ";
    for (const char letter : value)
        if (letter != '\r' && letter != '\n' && letter != '\0') text += letter;
    text += '\n';
}

/// A client takes "\n", "\r" and "\r\n" for the end of a line.
void add_data(std::string& text, std::string_view data) {
    for (;;) {
        const std::size_t end = data.find_first_of("\r\n");
        add_field(text, "data", data.substr(0, end));
        if (end == std::string_view::npos) return;
        data.remove_prefix(end + (data.substr(end).starts_with("\r\n") ? 2 : 1));
    }
}

} // namespace

std::string text_of(const PointsId& id) {
    std::array<char, 16> hex{};
    const auto end = std::to_chars(hex.data(), hex.data() + hex.size(), id.daemon, 16).ptr;
    return std::string(hex.data(), end) + "-" + std::to_string(id.run) + "-" +
           std::to_string(id.points);
}

std::optional<PointsId> points_id_of(std::string_view text) {
    const auto daemon = whole_number<std::uint64_t>(cut_at('-', text), 16);
    const auto run = whole_number<std::uint64_t>(cut_at('-', text));
    const auto points = whole_number<std::uint64_t>(text);
    if (!daemon || !run || !points) return std::nullopt;
    return PointsId{*daemon, *run, *points};
}

Result<EventsAsked> events_asked_of(std::string_view target, std::string_view last_event_id) {
    EventsAsked asked;
    asked.has = points_id_of(last_event_id);
    const std::string_view query = target.substr(std::min(target.find('?'), target.size()));
    if (query.empty() || query == "?") return asked;
    constexpr std::string_view key = "?stream=";
    if (!query.starts_with(key))
        return refuse(Fault::bad_request, "query", "is unknown; known is ?stream=200");
    const auto stretches = whole_number<std::size_t>(query.substr(key.size()));
    if (!stretches || *stretches < 1 || *stretches > most_stretches)
        return refuse(Fault::bad_request, "stream", "is a whole number from 1 to 4096");
    asked.stream_points = *stretches;
    return asked;
}

std::string event_text(std::string_view name, std::string_view data, std::string_view id) {
    std::string text;
    text.reserve(name.size() + data.size() + id.size() + 32);
    add_field(text, "event", name);
    if (!id.empty()) add_field(text, "id", id);
    add_data(text, data);
    return text += '\n';
}

std::string retry_text(std::chrono::milliseconds pause) {
    return "retry: " + std::to_string(pause.count()) + "\n\n";
}

std::string events_head() {
    return "HTTP/1.1 200 OK\r\n"
           "Content-Type: text/event-stream; charset=utf-8\r\n"
           "Cache-Control: no-store\r\n"
           "X-Content-Type-Options: nosniff\r\n"
           "X-Accel-Buffering: no\r\n" // a proxy must hand each event on at once
           "Connection: close\r\n\r\n";
}

} // namespace axiscal
