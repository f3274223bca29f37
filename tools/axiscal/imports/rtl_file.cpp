#include "tools/axiscal/imports/rtl_file.hpp"

#include "tools/axiscal/case_text.hpp"
#include "tools/axiscal/imports/text_lines.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <string>
#include <utility>

namespace axiscal {
namespace {

std::string in_small_letters(std::string_view text) {
    std::string out{text};
    std::ranges::transform(out, out.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
    });
    return out;
}

/// A count from 1 to `most`.
Result<std::size_t>
count_of(std::string_view word, std::size_t most, const char* what, std::size_t line) {
    std::size_t value = 0;
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (fault != std::errc{} || end != word.data() + word.size() || value < 1 || value > most)
        return refuse_line(line, std::string{what} + " \"" + std::string{word} +
                                     "\" is none from 1 to " + std::to_string(most));
    return value;
}

using Sections = std::map<std::string, std::vector<TextLine>>;

Result<Sections> sections_of(std::string_view text) {
    Sections sections;
    std::vector<TextLine>* open = nullptr;
    std::string name;
    for (const TextLine& line : lines_of(text)) {
        if (line.text.find(':') + 2 == line.text.size() && line.text.ends_with("::")) {
            name = in_small_letters(without_blanks(line.text.substr(0, line.text.size() - 2)));
            const bool again = sections.contains(name);
            if (again && (name == "header" || name == "target data" || name == "deviations"))
                return refuse_line(line.number, "a second section " + name +
                                                    ": two axes in one file; save each by itself");
            open = &sections[name];
        } else if (!line.text.empty()) {
            if (!open) return refuse_line(line.number, "stands before HEADER::");
            open->push_back(line);
        }
    }
    for (const char* needed : {"header", "target data", "runs", "deviations"})
        if (!sections.contains(needed))
            return refuse(Fault::bad_case, "file",
                          std::string{"has no section "} + needed + ": is it whole?");
    return sections;
}

struct KeyValue {
    std::string key; ///< small letters
    std::string_view value;
};

std::optional<KeyValue> key_value_of(std::string_view text) {
    const auto colon = text.find(':');
    if (colon == std::string_view::npos) return std::nullopt;
    return KeyValue{in_small_letters(without_blanks(text.substr(0, colon))),
                    without_blanks(text.substr(colon + 1))};
}

Result<AxisKind> kind_of(const Sections& sections, std::vector<std::string>& remarks) {
    std::string type;
    std::size_t at = 0;
    for (const TextLine& line : sections.at("header")) {
        const auto found = key_value_of(line.text);
        if (!found) continue;
        if (found->key == "file type") type = in_small_letters(found->value), at = line.number;
        constexpr std::string_view known = "V20.02.02";
        if (found->key == "version no" && found->value != known)
            remarks.push_back("The file is of version " + printable(found->value) +
                              "; this reader was made after " + std::string{known} + ".");
    }
    if (type == "rtl") return AxisKind::linear;
    if (type == "rta") return AxisKind::rotary;
    if (type == "pos") {
        remarks.emplace_back("The file is of type pos and is read as one of type rtl, in um; no "
                             "document of the maker says so.");
        return AxisKind::linear;
    }
    if (type.empty()) return refuse(Fault::bad_case, "file", "states no \"File type\"");
    return refuse_line(at, "file type \"" + printable(type) +
                               "\" is neither rtl (linear) nor rta (angular)");
}

constexpr std::size_t most_targets = 10'000, most_runs = 1000;

Result<std::vector<double>> targets_of(const std::vector<TextLine>& lines) {
    std::vector<double> targets;
    std::size_t stated = 0;
    bool open = false;
    for (const TextLine& line : lines) {
        const auto found = key_value_of(line.text);
        std::string_view numbers = open && !found ? line.text : std::string_view{};
        if (found) {
            open = found->key == "targets";
            if (open) numbers = found->value;
            if (found->key == "target-count") {
                AXISCAL_TRY(stated, count_of(found->value, most_targets, "the count of targets",
                                             line.number));
            }
        }
        for (const std::string_view word : words_of(numbers)) {
            AXISCAL_TRY(const double target, number_of(word, line.number));
            if (std::ranges::find(targets, target) != targets.end())
                return refuse_line(line.number,
                                   "the target " + std::string{word} + " stands twice");
            if (targets.size() == most_targets)
                return refuse_line(line.number,
                                   "has more than " + std::to_string(most_targets) + " targets");
            targets.push_back(target);
        }
    }
    if (stated == 0) return refuse(Fault::bad_case, "file", "states no \"Target-count\"");
    if (targets.size() != stated)
        return refuse(Fault::bad_case, "file",
                      "has " + std::to_string(targets.size()) + " targets and states " +
                          std::to_string(stated) + ": is it whole?");
    return targets;
}

/// Where some numbers have a point, a comma may part thousands.
Result<void> check_marks(const Sections& sections) {
    bool point = false;
    std::size_t comma = 0;
    for (const char* name : {"target data", "deviations"})
        for (const TextLine& line : sections.at(name)) {
            if (line.text.find_first_not_of("+-.,0123456789 \t") != std::string_view::npos)
                continue;
            point = point || line.text.find('.') != std::string_view::npos;
            if (comma == 0 && line.text.find(',') != std::string_view::npos) comma = line.number;
        }
    if (!point || comma == 0) return {};
    return refuse_line(comma, "has a comma where other numbers have a point");
}

/// "0 0 2 0" was written for both directions, "0 1 2 0" for one.
bool says_both_directions(const std::vector<TextLine>& lines) {
    for (const TextLine& line : lines)
        if (const auto found = key_value_of(line.text); found && found->key == "flags") {
            const auto flags = words_of(found->value);
            return flags.size() > 1 && flags[1] == "0";
        }
    return false;
}

Result<std::size_t> runs_of(const std::vector<TextLine>& lines) {
    for (const TextLine& line : lines)
        if (const auto found = key_value_of(line.text); found && found->key == "run-count")
            return count_of(found->value, most_runs, "the count of runs", line.number);
    return refuse(Fault::bad_case, "file", "states no \"Run-count\"");
}

Result<void> add_reading(LaserReadings& out, const TextLine& line) {
    const auto words = words_of(line.text);
    if (words.size() != 3)
        return refuse_line(line.number, "has " + std::to_string(words.size()) +
                                            " words; a reading has run, target and value");
    AXISCAL_TRY(const std::size_t run, count_of(words[0], out.passes.size(), "run", line.number));
    AXISCAL_TRY(const std::size_t target,
                count_of(words[1], out.targets.size(), "target", line.number));
    AXISCAL_TRY(const double value, number_of(words[2], line.number));
    LaserPass& pass = out.passes[run - 1];
    if (pass.readings[target - 1])
        return refuse_line(line.number, "run " + std::to_string(run) + " has target " +
                                            std::to_string(target) + " twice");
    if (pass.order.empty()) pass.line = line.number;
    pass.order.push_back(target - 1);
    pass.readings[target - 1] = value;
    return {};
}

/// One writer lists a test from one side with a run of zeros behind each real one.
void drop_empty_runs(LaserReadings& out) {
    const auto is_zero = [](const LaserPass& pass) {
        return std::ranges::all_of(pass.readings,
                                   [](const auto& reading) { return reading == 0.0; });
    };
    bool all = out.passes.size() % 2 == 0;
    for (std::size_t i = 1; i < out.passes.size(); i += 2)
        all = all && is_zero(out.passes[i]);
    if (!all || out.says_both_directions) return;
    std::vector<LaserPass> kept;
    for (std::size_t i = 0; i < out.passes.size(); i += 2)
        kept.push_back(std::move(out.passes[i]));
    out.passes = std::move(kept);
    out.remarks.emplace_back(
        "The file says that it holds one direction, and each even run is zero throughout: "
        "these are left out.");
}

/// The unit of .rta is not written in it; the one public reader takes mrad.
void take_angles(LaserReadings& out) {
    constexpr double arcsec_per_mrad = 206.26480624709636; // 180 * 3.6 / pi
    out.target_unit = "deg";
    out.unit = "arcsec";
    for (LaserPass& pass : out.passes)
        for (auto& reading : pass.readings)
            if (reading) *reading *= arcsec_per_mrad;
    out.remarks.emplace_back(
        "Deviations of .rta are taken as milliradians, as one public reader does; no document "
        "of the maker says so.");
}

void add_statements(LaserReadings& out, const Sections& sections) {
    for (const char* name : {"user-text", "equipment", "environment"}) {
        const auto section = sections.find(name);
        if (section == sections.end()) continue;
        for (const TextLine& line : section->second) {
            const auto colon = line.text.find(':');
            if (colon == std::string_view::npos) continue;
            const auto value = without_blanks(line.text.substr(colon + 1));
            if (!value.empty())
                out.statements.emplace_back(without_blanks(line.text.substr(0, colon)), value);
        }
    }
}

} // namespace

bool is_rtl(std::string_view utf8) {
    const auto begin = std::min(utf8.find_first_not_of(" \t\r\n"), utf8.size());
    return in_small_letters(utf8.substr(begin, 8)) == "header::";
}

Result<LaserReadings> read_rtl(std::string_view utf8) {
    LaserReadings out;
    AXISCAL_TRY(const Sections sections, sections_of(utf8));
    AXISCAL_TRY(out.kind, kind_of(sections, out.remarks));
    AXISCAL_CHECK(check_marks(sections));
    AXISCAL_TRY(out.targets, targets_of(sections.at("target data")));
    out.says_both_directions = says_both_directions(sections.at("target data"));
    AXISCAL_TRY(const std::size_t runs, runs_of(sections.at("runs")));
    for (std::size_t i = 0; i < runs; ++i)
        out.passes.push_back({"run " + std::to_string(i + 1),
                              0,
                              {},
                              std::vector<std::optional<double>>(out.targets.size()),
                              {}});
    for (const TextLine& line : sections.at("deviations"))
        if (!in_small_letters(line.text).starts_with("run ")) AXISCAL_CHECK(add_reading(out, line));
    drop_empty_runs(out);
    if (out.kind == AxisKind::rotary) take_angles(out);
    if (!sections.contains("eof"))
        out.remarks.emplace_back(
            "The file does not end with EOF::, so that its end may be missing.");
    add_statements(out, sections);
    return out;
}

} // namespace axiscal
