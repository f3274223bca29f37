#include "tools/axiscal/imports/umd_file.hpp"

#include "analysis/quantity/counted.hpp"
#include "tools/axiscal/case_text.hpp"
#include "tools/axiscal/imports/standstills.hpp"
#include "tools/axiscal/imports/text_lines.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {
namespace {

struct UmdSample {
    std::int64_t count = 0;
    std::uint64_t sequence = 0;
    std::size_t line = 0;
};

/// From one "Enable Capture" to the next.
struct UmdSegment {
    std::size_t line = 0;
    std::optional<double> rate_Hz;
    std::vector<UmdSample> samples;
};

template <class Integer> std::optional<Integer> whole_number(std::string_view word) {
    Integer value = 0;
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (fault != std::errc{} || end != word.data() + word.size()) return std::nullopt;
    return value;
}

constexpr std::string_view frequency_title = "Sample Frequency";

bool begins_segment(std::string_view line) {
    return line.starts_with(frequency_title) || line == "Gap";
}

/// "Sample Frequency = 610.35 Hz", or "Gap", as the program of 2015 has it.
Result<UmdSegment> segment_of(std::string_view line, std::size_t number) {
    UmdSegment segment;
    segment.line = number;
    if (!line.starts_with(frequency_title)) return segment;
    const auto words = words_of(line);
    if (words.size() != 5 || words[2] != "=" || words[4] != "Hz")
        return refuse_line(number, "is no \"Sample Frequency = ... Hz\"");
    AXISCAL_TRY(const double rate_Hz, number_of(words[3], number));
    if (rate_Hz < 0.1 || rate_Hz > 1e6)
        return refuse_line(number, "its sample frequency is none from 0.1 Hz to 1 MHz");
    segment.rate_Hz = rate_Hz;
    return segment;
}

Result<UmdSample> umd_sample(std::string_view line, std::size_t number) {
    if (line.starts_with("R:") || (line.starts_with("D:") && line.ends_with('T')))
        return refuse_line(number, "is of the program's test mode, which makes its readings up: "
                                   "switch it off and measure");
    const auto words = words_of(line);
    const bool two = words.size() == 2 && words[0].starts_with("D:") && words[1].starts_with("N:");
    const auto count = two ? whole_number<std::int64_t>(words[0].substr(2)) : std::nullopt;
    const auto sequence = two ? whole_number<std::uint64_t>(words[1].substr(2)) : std::nullopt;
    constexpr std::int64_t largest_count = 1'000'000'000'000'000; // 80 km at 0.08 nm a count
    if (!count || !sequence || *count > largest_count || *count < -largest_count)
        return refuse_line(number, "\"" + printable(line.substr(0, 40)) +
                                       "\" is no \"D:<count> N:<number>\"");
    return UmdSample{*count, *sequence, number};
}

/// Those that hold samples.
Result<std::vector<UmdSegment>> segments_of(std::string_view text) {
    std::vector<UmdSegment> segments;
    for (std::size_t number = 1, end = 0; (end = text.find('\n')) != std::string_view::npos;
         ++number) {
        const std::string_view line = without_blanks(text.substr(0, end));
        text.remove_prefix(end + 1);
        if (line.empty()) continue;
        if (begins_segment(line)) {
            if (!segments.empty() && segments.back().samples.empty()) segments.pop_back();
            AXISCAL_TRY(UmdSegment segment, segment_of(line, number));
            segments.push_back(std::move(segment));
            continue;
        }
        if (segments.empty()) segments.push_back({number, std::nullopt, {}});
        AXISCAL_TRY(const UmdSample sample, umd_sample(line, number));
        segments.back().samples.push_back(sample);
    }
    if (!segments.empty() && segments.back().samples.empty()) segments.pop_back();
    return segments;
}

Result<UmdSegment> chosen_segment(std::string_view text, int wanted) {
    AXISCAL_TRY(auto segments, segments_of(text));
    if (segments.empty()) return refuse(Fault::bad_case, "file", "holds no sample");
    const auto count = segments.size();
    if (wanted == 0 && count == 1) return std::move(segments.front());
    if (wanted >= 1 && static_cast<std::size_t>(wanted) <= count)
        return std::move(segments[static_cast<std::size_t>(wanted) - 1]);
    std::string lines;
    for (std::size_t i = 0; i < std::min<std::size_t>(count, 8); ++i)
        lines += (i == 0 ? "" : ", ") + std::to_string(segments[i].line);
    return refuse(Fault::bad_case, "file",
                  "holds " + counted(static_cast<long>(count), "capture") + ", from the lines " +
                      lines + (count > 8 ? ", ..." : "") +
                      " on; segment under [counts] of the map names the one to be read, from 1");
}

/// The number of a sample since the first, from 1, however often its counter began again.
class UmdNumbering {
public:
    UmdNumbering(const UmdSample& first, int bits)
        : last_{first.sequence}
        , bits_{bits} {}

    Result<std::uint64_t> next(const UmdSample& sample) {
        AXISCAL_CHECK(learn_width(sample));
        const std::uint64_t all = bits_ > 0 ? (std::uint64_t{1} << bits_) - 1 : ~std::uint64_t{0};
        if (sample.sequence > all)
            return refuse_line(sample.line, "its number has more than " + std::to_string(bits_) +
                                                " bits, the sequence_bits of the map or of the "
                                                "file before it");
        const std::uint64_t step = (sample.sequence - last_) & all;
        constexpr std::uint64_t farthest_step = 1'000'000'000;
        if (step == 0 || step > farthest_step)
            return refuse_line(sample.line, "N:" + std::to_string(sample.sequence) +
                                                " follows N:" + std::to_string(last_) +
                                                ": samples stand twice, or not in their order");
        last_ = sample.sequence;
        lost_ += step - 1;
        return number_ += step;
    }
    [[nodiscard]] std::uint64_t lost() const { return lost_; }

private:
    /// No document tells how many bits a number has: it shows where 2^bits - 1 is followed by 0.
    Result<void> learn_width(const UmdSample& sample) {
        if (sample.sequence > last_ || bits_ > 0) return {};
        for (int bits = 8; bits < 64 && sample.sequence == 0; ++bits)
            if (last_ == (std::uint64_t{1} << bits) - 1) bits_ = bits;
        if (bits_ > 0 || sample.sequence == last_) return {};
        return refuse_line(sample.line,
                           "N:" + std::to_string(sample.sequence) +
                               " follows N:" + std::to_string(last_) +
                               ": how many samples are lost shows only with the width of the "
                               "number, sequence_bits under [counts] of the map; or cut the file "
                               "here");
    }

    std::uint64_t last_, number_ = 1, lost_ = 0;
    int bits_;
};

Result<double> rate_of(const UmdSegment& segment, const UmdMap& map) {
    if (segment.rate_Hz) return *segment.rate_Hz;
    if (map.rate_Hz) return *map.rate_Hz;
    return refuse_line(segment.line, "the file does not state its sample frequency here: state "
                                     "rate_Hz under [counts] of the map");
}

struct UmdCourse {
    std::vector<AxisSample> samples;
    std::uint64_t lost = 0;
};

/// Positions from the first sample on.
Result<UmdCourse> course_of(const UmdSegment& segment, const UmdMap& map) {
    AXISCAL_TRY(const double rate_Hz, rate_of(segment, map));
    const UmdSample& first = segment.samples.front();
    UmdNumbering numbering{first, map.sequence_bits};
    UmdCourse course;
    course.samples.reserve(segment.samples.size());
    course.samples.push_back({MonotonicTime{}, 0, 1, first.line});
    for (std::size_t i = 1; i < segment.samples.size(); ++i) {
        const UmdSample& sample = segment.samples[i];
        AXISCAL_TRY(const std::uint64_t number, numbering.next(sample));
        const double at_s = static_cast<double>(number - 1) / rate_Hz;
        constexpr double longest_s = 100 * 86'400.0; // no test lasts so
        if (at_s > longest_s)
            return refuse_line(sample.line, "comes more than 100 days after the first sample by "
                                            "its number: is the file whole?");
        course.samples.push_back(
            {MonotonicTime{from_seconds(at_s)},
             static_cast<double>(sample.count - first.count) * map.metres_per_count, number,
             sample.line});
    }
    course.lost = numbering.lost();
    return course;
}

} // namespace

bool is_umd(std::string_view utf8) {
    constexpr std::string_view blanks = " \t\r\n";
    utf8.remove_prefix(std::min(utf8.find_first_not_of(blanks), utf8.size()));
    const std::string_view line = without_blanks(utf8.substr(0, utf8.find('\n')));
    const auto words = words_of(line.substr(0, 200));
    const bool sample = words.size() >= 2 && words.back().starts_with("N:") &&
                        (words.front().starts_with("D:") || words.front().starts_with("R:"));
    return sample || begins_segment(line);
}

Result<LaserReadings> read_umd(std::string_view utf8, const UmdMap& map) {
    AXISCAL_TRY(const UmdSegment segment, chosen_segment(utf8, map.segment));
    AXISCAL_TRY(UmdCourse course, course_of(segment, map));
    AXISCAL_CHECK(tie_datum(course.samples, map.stops));
    AXISCAL_TRY(LaserReadings out, readings_of_standstills(course.samples, map.stops));
    out.remarks.emplace_back("Counts became lengths by the map alone: neither air nor material was "
                             "compensated beyond what it states.");
    if (course.lost > 0)
        out.remarks.push_back(counted(static_cast<long>(course.lost), "sample is", "samples are") +
                              " lost, none of them within a window that counts.");
    return out;
}

} // namespace axiscal
