#include "tools/axiscal/imports/stream_file.hpp"

#include "analysis/quantity/counted.hpp"
#include "tools/axiscal/case_text.hpp"
#include "tools/axiscal/imports/passes.hpp"
#include "tools/axiscal/imports/standstills.hpp"
#include "tools/axiscal/imports/text_lines.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace axiscal {
namespace {

struct Value {
    std::int64_t at_us = 0;
    double value = 0;
    std::size_t line = 0;
};

struct StreamLine {
    std::string_view name, value, severity;
    std::int64_t at_us = 0;
};

std::string_view next_word(std::string_view& text) {
    constexpr std::string_view blanks = " \t\r";
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    const auto word = text.substr(0, text.find_first_of(blanks));
    text.remove_prefix(word.size());
    return word;
}

/// Digits that stand at `from`, `count` of them; -1 where they do not.
int digits_at(std::string_view text, std::size_t from, std::size_t count) {
    int value = -1;
    if (text.size() < from + count) return value;
    const char* const end = text.data() + from + count;
    const auto [stop, fault] = std::from_chars(text.data() + from, end, value);
    return fault == std::errc{} && stop == end ? value : -1;
}

/// "2022-04-06" and "12:48:22.148376" as microseconds; nothing where they are none.
std::optional<std::int64_t> time_of(std::string_view date, std::string_view clock) {
    const int year = digits_at(date, 0, 4), month = digits_at(date, 5, 2),
              day = digits_at(date, 8, 2);
    const int hour = digits_at(clock, 0, 2), minute = digits_at(clock, 3, 2);
    const int second = digits_at(clock, 6, 2);
    if (date.size() != 10 || std::min({year, month, day, hour, minute, second}) < 0) return {};
    const std::chrono::year_month_day calendar{std::chrono::year{year},
                                               std::chrono::month{static_cast<unsigned>(month)},
                                               std::chrono::day{static_cast<unsigned>(day)}};
    if (!calendar.ok()) return {};
    const std::string_view rest = clock.substr(std::min<std::size_t>(8, clock.size()));
    const std::size_t places = rest.size() < 2 ? 0 : std::min<std::size_t>(rest.size() - 1, 6);
    int fraction = places == 0 ? 0 : digits_at(rest, 1, places);
    if (fraction < 0) return {};
    for (std::size_t i = places; i < 6; ++i)
        fraction *= 10;
    const std::int64_t seconds =
        std::chrono::sys_days{calendar}.time_since_epoch().count() * std::int64_t{86'400} +
        hour * 3600 + minute * 60 + second;
    return seconds * 1'000'000 + fraction;
}

std::optional<StreamLine> stream_line(std::string_view text) {
    StreamLine line;
    line.name = next_word(text);
    const auto date = next_word(text), clock = next_word(text);
    line.value = next_word(text);
    next_word(text); // status
    line.severity = next_word(text);
    const auto at = time_of(date, clock);
    if (!at || line.value.empty()) return std::nullopt;
    line.at_us = *at;
    return line;
}

std::optional<double> number_in(std::string_view word) {
    double value = 0;
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (fault != std::errc{} || end != word.data() + word.size() || !std::isfinite(value))
        return {};
    return value;
}

/// The values of the names that the map wants.
struct Signals {
    std::map<std::string, std::vector<Value>, std::less<>> of;
    long alarms = 0;
};

Result<void> take_line(std::string_view text, std::size_t number, Signals& signals) {
    std::string_view rest = text;
    const auto name = next_word(rest);
    if (name.empty() || name.starts_with('#')) return {};
    const auto wanted = signals.of.find(name);
    if (wanted == signals.of.end()) return {};
    const auto line = stream_line(text);
    const auto value = line ? number_in(line->value) : std::nullopt;
    if (!value) return refuse_line(number, "is no \"NAME DATE TIME VALUE\": is the file whole?");
    if (line->severity == "INVALID")
        return refuse_line(number, printable(name) + " was not valid here (severity INVALID)");
    if (!line->severity.empty() && line->severity != "NO_ALARM") ++signals.alarms;
    wanted->second.push_back({line->at_us, *value, number});
    return {};
}

Result<Signals> signals_of(std::string_view text, const StreamMap& map) {
    Signals signals;
    for (const std::string& name : {map.reading, map.target, map.capture})
        if (!name.empty()) signals.of[name];
    for (std::size_t number = 1; !text.empty(); ++number) {
        const auto end = std::min(text.find('\n'), text.size());
        AXISCAL_CHECK(take_line(text.substr(0, end), number, signals));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    for (auto& [name, values] : signals.of) {
        if (values.empty())
            return refuse(Fault::bad_case, "file",
                          "has no line of " + name + ", which the map names");
        std::ranges::stable_sort(values, {}, &Value::at_us);
    }
    return signals;
}

/// The newest value at or before a time.
const Value* value_at(const std::vector<Value>& values, std::int64_t at_us) {
    const auto after = std::ranges::upper_bound(values, at_us, {}, &Value::at_us);
    return after == values.begin() ? nullptr : &*std::prev(after);
}

Result<double>
reading_at(const std::vector<Value>& values, const StreamMap& map, const Value& capture) {
    constexpr std::int64_t ns_per_us = 1000;
    const auto position = [&map](double value) { return map.scale * value + map.offset; };
    const auto nothing = [&] {
        return refuse_line(capture.line, map.reading + " has no value at this capture");
    };
    if (!map.before) {
        const Value* last = value_at(values, capture.at_us);
        if (last == nullptr) return nothing();
        return position(last->value);
    }
    const std::int64_t from = capture.at_us - map.before->count() / ns_per_us;
    const std::int64_t to = capture.at_us + map.after.value_or(Duration{}).count() / ns_per_us;
    double sum = 0;
    long n = 0;
    for (auto at = std::ranges::lower_bound(values, from, {}, &Value::at_us);
         at != values.end() && at->at_us <= to; ++at)
        sum += position(at->value), ++n;
    if (n == 0) return nothing();
    return sum / static_cast<double>(n);
}

/// What the number of a capture says, by the letters of the map.
struct Numbered {
    int direction = -1, cycle = -1, position = -1; ///< -1: the map does not say
};

Result<Numbered> numbered(const Value& capture, const std::string& digits) {
    Numbered out;
    if (digits.empty()) return out;
    constexpr double largest = 999'999'999; // as many digits as a map may name
    const bool whole = capture.value >= 0 && capture.value <= largest &&
                       capture.value == std::round(capture.value);
    std::string text = whole ? std::to_string(std::llround(capture.value)) : std::string{};
    if (text.size() < digits.size()) text.insert(0, digits.size() - text.size(), '0');
    if (!whole || text.size() > digits.size())
        return refuse_line(capture.line,
                           "its number does not have the digits " + digits + " of the map");
    for (std::size_t i = 0; i < digits.size(); ++i) {
        int* const part = digits[i] == 'd'   ? &out.direction
                          : digits[i] == 'c' ? &out.cycle
                          : digits[i] == 'p' ? &out.position
                                             : nullptr;
        if (part != nullptr) *part = std::max(*part, 0) * 10 + (text[i] - '0');
    }
    return out;
}

class Stream {
public:
    Stream(const Signals& signals, const StreamMap& map)
        : signals_{signals}
        , map_{map} {}

    Result<std::vector<Captured>> captures() {
        std::vector<Captured> list;
        double last = 0;
        for (const Value& number : signals_.of.find(map_.capture)->second) {
            const bool again = number.value == last;
            last = number.value;
            if (number.value == 0 || again || was_there_before(number)) continue;
            AXISCAL_TRY(Captured captured, capture(number));
            list.push_back(std::move(captured));
        }
        if (list.empty())
            return refuse(Fault::bad_case, "file",
                          map_.capture + " never changes: no capture in it");
        return list;
    }

private:
    /// A stream begins with the last value of each name, however old it is.
    [[nodiscard]] bool was_there_before(const Value& number) const {
        return &number == &signals_.of.find(map_.capture)->second.front() &&
               value_at(signals_.of.find(map_.reading)->second, number.at_us) == nullptr;
    }

    Result<Captured> capture(const Value& number) {
        AXISCAL_TRY(const Numbered says, numbered(number, map_.digits));
        Captured out;
        out.line = number.line;
        if (says.direction >= 0) {
            if (says.direction != map_.forward && says.direction != map_.backward)
                return refuse_line(number.line, "the direction " + std::to_string(says.direction) +
                                                    " is neither forward nor backward of the map");
            out.says_forward = says.direction == map_.forward;
        }
        AXISCAL_TRY(out.target, target_of(says, number));
        AXISCAL_TRY(out.reading, reading_at(signals_.of.find(map_.reading)->second, map_, number));
        if (!std::isfinite(out.reading)) return refuse_line(number.line, "has no finite reading");
        if (says.cycle < 0) return out; // the order of the targets tells where a pass ends
        out.group = "cycle " + std::to_string(says.cycle);
        if (out.says_forward) out.pass = (*out.says_forward ? "forward " : "backward ") + out.group;
        return out;
    }

    Result<double> target_of(const Numbered& says, const Value& number) {
        if (map_.target.empty()) {
            const auto m = static_cast<int>(map_.places.size());
            if (says.position < 1 || says.position > m)
                return refuse_line(number.line, "the position " + std::to_string(says.position) +
                                                    " is none from 1 to " + std::to_string(m));
            return map_.places[static_cast<std::size_t>(says.position - 1)];
        }
        const Value* target = value_at(signals_.of.find(map_.target)->second, number.at_us);
        if (target == nullptr)
            return refuse_line(number.line, map_.target + " has no value before this capture");
        if (says.position >= 0) {
            const auto [known, first] = target_of_position_.emplace(says.position, target->value);
            if (!first && known->second != target->value)
                return refuse_line(number.line, "position " + std::to_string(says.position) +
                                                    " has another target than before: the captures "
                                                    "do not fit the plan");
        }
        return target->value;
    }

    const Signals& signals_;
    const StreamMap& map_;
    std::map<int, double> target_of_position_;
};

/// The axis as its instrument saw it; times count from the first value.
Result<std::vector<AxisSample>> axis_samples(const std::vector<Value>& values,
                                             const ImportMap& map) {
    const StreamMap& of = std::get<StreamMap>(map.of);
    constexpr std::int64_t longest_us = std::int64_t{100} * 86'400 * 1'000'000; // no test lasts so
    const std::int64_t first_us = values.front().at_us;
    if (values.back().at_us - first_us > longest_us)
        return refuse(Fault::bad_case, "file",
                      "has values of " + of.reading + " over more than 100 days: cut out the test");
    const double millimetres = millimetres_in(map.unit);
    std::vector<AxisSample> samples;
    samples.reserve(values.size());
    for (const Value& value : values)
        samples.push_back({monotonic_from_ns((value.at_us - first_us) * 1000),
                           mm((of.scale * value.value + of.offset) * millimetres).si(), 0,
                           value.line});
    return samples;
}

Result<LaserReadings> readings_at_captures(const Signals& signals, const ImportMap& map) {
    AXISCAL_TRY(const auto captures, Stream(signals, std::get<StreamMap>(map.of)).captures());
    LaserReadings out;
    out.kind = map.kind;
    out.unit = out.target_unit = map.unit;
    out.positions = true;
    AXISCAL_CHECK(add_passes(captures, out));
    return out;
}

Result<LaserReadings> readings_where_it_stands(const Signals& signals, const ImportMap& map) {
    const StreamMap& of = std::get<StreamMap>(map.of);
    AXISCAL_TRY(const auto samples, axis_samples(signals.of.find(of.reading)->second, map));
    return readings_of_standstills(samples, *of.stops);
}

} // namespace

bool is_stream(std::string_view utf8) {
    return stream_line(utf8.substr(0, utf8.find('\n'))).has_value();
}

Result<LaserReadings> read_stream(std::string_view utf8, const ImportMap& map) {
    const StreamMap& of = std::get<StreamMap>(map.of);
    AXISCAL_TRY(const Signals signals, signals_of(utf8, of));
    AXISCAL_TRY(LaserReadings out, of.stops ? readings_where_it_stands(signals, map)
                                            : readings_at_captures(signals, map));
    if (signals.alarms > 0)
        out.remarks.push_back(counted(signals.alarms, "value") +
                              " of the stream had an alarm and were taken all the same.");
    return out;
}

} // namespace axiscal
