#include "cnc/linuxcnc_program.hpp"

#include "cnc/expression.hpp"
#include "cnc/program_line.hpp"

#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

namespace axiscal::simulate {

namespace {

/// Tenths of the code, so that G61.1 is 611 and G1 is 10.
using Codes = std::set<int>;

/// Codes without effect on one linear axis in mm and mm/min.
const Codes settled_g{170, 210, 400, 490, 540, 610, 611, 640, 900, 940};
const Codes known_g{0, 10, 40, 800};
/// Of a program for two axes: which plane, and centre words relative to the begin of an arc.
const Codes settled_plane_g{180, 190, 911}, known_plane_g{20, 30};
const Codes known_m{20, 300, 640, 650, 660, 670, 680};

struct Words {
    Codes g, m;
    std::map<char, double> values;
};

Result<Words> read_words(const std::string& text, int line, const Parameters& parameters) {
    Words words;
    ExpressionReader in{text, parameters};
    while (!in.done()) {
        const char letter = in.next();
        if (std::isalpha(static_cast<unsigned char>(letter)) == 0)
            return at_line(line, "\"" + std::string{in.rest()} + "\" is not understood");
        in.take(letter);
        const double value = in.value();
        if (in.failed()) break;
        const int tenths = static_cast<int>(std::lround(value * 10));
        if (letter == 'g')
            words.g.insert(tenths);
        else if (letter == 'm')
            words.m.insert(tenths);
        else if (!words.values.emplace(letter, value).second)
            return at_line(line, std::string{"the word "} + letter + " stands twice");
    }
    if (in.failed()) return at_line(line, in.reason());
    return words;
}

std::string without_blanks(const std::string& text) {
    std::string clean;
    for (const char c : text)
        if (std::isspace(static_cast<unsigned char>(c)) == 0)
            clean += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return clean;
}

/// Takes the comments out; the text of an active (ABORT,...) goes to `abort`.
std::optional<std::string> strip_comments(const std::string& line,
                                          std::optional<std::string>& abort) {
    std::string code;
    for (std::size_t i = 0; i < line.size() && line[i] != ';'; ++i) {
        if (line[i] != '(') {
            code += line[i];
            continue;
        }
        const auto end = line.find(')', i);
        if (end == std::string::npos) return std::nullopt;
        const std::string comment = line.substr(i + 1, end - i - 1);
        if (without_blanks(comment).starts_with("abort,"))
            abort = comment.substr(comment.find(',') + 1);
        i = end;
    }
    return without_blanks(code);
}

std::string code_name(char letter, int tenths) {
    std::string name{static_cast<char>(std::toupper(letter))};
    name += std::to_string(tenths / 10);
    return tenths % 10 == 0 ? name : name + "." + std::to_string(tenths % 10);
}

/// X, Y, Z have I, J, K.
char centre_letter(char axis) {
    return static_cast<char>('i' + (axis - 'x'));
}

/// Every word must have somebody who uses it, as LinuxCNC demands.
Result<void> check_words(const Words& w, int line, char axis, const std::string& plane) {
    const auto known_for_plane = [&](int g) {
        return !plane.empty() && (settled_plane_g.contains(g) || known_plane_g.contains(g));
    };
    for (const int g : w.g)
        if (!settled_g.contains(g) && !known_g.contains(g) && !known_for_plane(g))
            return at_line(line, code_name('g', g) + " is not understood");
    for (const int m : w.m)
        if (!known_m.contains(m)) return at_line(line, code_name('m', m) + " is not understood");
    std::set<char> used{'n', 'f', axis};
    used.insert(plane.begin(), plane.end());
    if (w.g.contains(20) || w.g.contains(30))
        used.insert({'p', centre_letter(plane[0]), centre_letter(plane[1])});
    if (w.g.contains(40) || w.g.contains(640)) used.insert('p');
    if (w.m.contains(640) || w.m.contains(650)) used.insert('p');
    if (w.m.contains(660)) used.insert({'p', 'l', 'q'});
    if (w.m.contains(670) || w.m.contains(680)) used.insert({'e', 'q'});
    for (const auto& [letter, value] : w.values)
        if (!used.contains(letter))
            return at_line(line, std::string{"the word "} +
                                     static_cast<char>(std::toupper(letter)) +
                                     " is not understood here");
    const auto needs = [&](int m, char letter) {
        return w.m.contains(m) && !w.values.contains(letter);
    };
    const bool missing = (w.g.contains(40) && !w.values.contains('p')) || needs(640, 'p') ||
                         needs(650, 'p') || needs(660, 'p') || needs(660, 'l') || needs(670, 'e') ||
                         needs(670, 'q') || needs(680, 'e') || needs(680, 'q');
    if (missing) return at_line(line, "a word that the code needs (P, L, E or Q) is missing");
    return {};
}

} // namespace

struct LinuxcncProgram::State {
    std::optional<std::pair<int, double>> with_next_way; ///< of M67: output and value
    Parameters parameters;
    std::optional<int> motion; ///< 0 or 10: the modal G0 or G1
    double feed_mm_per_min = 0;
    bool ended = false;
    bool seeking_arm = false; ///< the tests of this if have failed so far
    std::size_t next = 0;
};

Result<LinuxcncProgram::Block> LinuxcncProgram::read_o_word(const std::string& text, int line) {
    static const std::map<std::string, Kind> keywords{
        {"if", Kind::if_},      {"elseif", Kind::elseif}, {"else", Kind::else_},
        {"endif", Kind::endif}, {"while", Kind::while_},  {"endwhile", Kind::endwhile}};
    const Parameters none;
    ExpressionReader in{std::string_view{text}.substr(1), none};
    Block block{line, Kind::words, {}, in.parameter_name(), 0};
    if (in.failed()) return at_line(line, "an o-word needs a number or <name>");
    const std::string rest{in.rest()};
    const auto bracket = rest.find('[');
    const auto found = keywords.find(rest.substr(0, bracket));
    if (found == keywords.end()) return at_line(line, "o-word \"" + rest + "\" is not understood");
    block.kind = found->second;
    block.text = bracket == std::string::npos ? "" : rest.substr(bracket);
    const bool tests =
        block.kind == Kind::if_ || block.kind == Kind::elseif || block.kind == Kind::while_;
    if (tests != !block.text.empty())
        return at_line(line, tests ? "an [expression] is missing" : "no expression belongs here");
    return block;
}

Result<void> LinuxcncProgram::add_line(const std::string& line, int number) {
    std::optional<std::string> abort;
    const auto code = strip_comments(line, abort);
    if (!code) return at_line(number, "a comment is not closed");
    if (abort) blocks_.push_back({number, Kind::abort, *abort, {}, 0});
    if (code->empty() || *code == "%") return {};
    if (code->starts_with('o')) {
        AXISCAL_TRY(Block block, read_o_word(*code, number));
        blocks_.push_back(std::move(block));
        return {};
    }
    const Kind kind = code->starts_with('#') ? Kind::assignments : Kind::words;
    blocks_.push_back({number, kind, *code, {}, 0});
    return {};
}

/// Ties each arm of an if to the next and each while to its end; arms nest.
Result<void> LinuxcncProgram::match_o_words() {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
        Block& block = blocks_[i];
        if (block.label.empty()) continue;
        if (block.kind == Kind::if_ || block.kind == Kind::while_) {
            open.push_back(i);
            continue;
        }
        const bool ends_while = block.kind == Kind::endwhile;
        const bool fits = !open.empty() && blocks_[open.back()].label == block.label &&
                          (blocks_[open.back()].kind == Kind::while_) == ends_while;
        if (!fits) return at_line(block.line, "this o-word has no beginning");
        blocks_[open.back()].jump = i;
        if (ends_while) block.jump = open.back();
        open.pop_back();
        if (block.kind == Kind::elseif || block.kind == Kind::else_) open.push_back(i);
    }
    if (!open.empty()) return at_line(blocks_[open.back()].line, "this o-word has no end");
    return {};
}

/// Every block once, parameters read as 0, nothing moves: finds what is not understood.
Result<void> LinuxcncProgram::check() const {
    State state;
    state.parameters.strict = false;
    for (const Block& block : blocks_) {
        if (block.kind == Kind::assignments) {
            auto assigned = assign(block, state);
            if (!assigned) return assigned;
        } else if (block.kind == Kind::words) {
            AXISCAL_TRY(const Words words, read_words(block.text, block.line, state.parameters));
            auto checked = check_words(words, block.line, axis_letter_, plane_);
            if (!checked) return checked;
        } else if (!block.text.empty() && block.kind != Kind::abort) {
            auto tested = test(block, state);
            if (!tested) return tested;
        }
    }
    return {};
}

Result<LinuxcncProgram>
LinuxcncProgram::parse(const std::string& text, char axis_letter, const std::string& plane) {
    LinuxcncProgram program;
    for (const char letter : plane)
        program.plane_ += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    program.axis_letter_ = static_cast<char>(std::tolower(static_cast<unsigned char>(axis_letter)));
    std::istringstream lines{text};
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        auto added = program.add_line(line, ++number);
        if (!added) return tl::unexpected<Error>(added.error());
    }
    auto matched = program.match_o_words().and_then([&] { return program.check(); });
    if (!matched) return tl::unexpected<Error>(matched.error());
    return program;
}

Result<void> LinuxcncProgram::assign(const Block& block, State& state) {
    ExpressionReader in{block.text, state.parameters};
    std::map<std::string, double> given; // LinuxCNC sets parameters after the whole line is read
    while (!in.done()) {
        if (!in.take('#')) return at_line(block.line, "\"" + block.text + "\" is not understood");
        const std::string name = in.parameter_name();
        if (!in.take('=')) return at_line(block.line, "an = is missing after #" + name);
        given[name] = in.value();
    }
    if (in.failed()) return at_line(block.line, in.reason());
    for (const auto& [name, value] : given)
        state.parameters.values[name] = value;
    return {};
}

/// if, elseif and while: on into the body, or to the next arm, or past the loop.
Result<void> LinuxcncProgram::test(const Block& block, State& state) {
    ExpressionReader in{block.text, state.parameters};
    const bool holds = in.value() != 0;
    if (in.failed() || !in.done())
        return at_line(block.line, in.failed() ? in.reason() : "text after the expression");
    state.seeking_arm = !holds && block.kind != Kind::while_;
    if (!holds) state.next = block.kind == Kind::while_ ? block.jump + 1 : block.jump;
    return {};
}

/// An arm has run; what follows up to the endif does not.
void LinuxcncProgram::skip_to_endif(State& state) const {
    --state.next; // the arm that was met
    while (blocks_[state.next].kind != Kind::endif)
        state.next = blocks_[state.next].jump;
}

Result<void>
LinuxcncProgram::execute_words(const Block& block, State& state, MachineActions& machine) const {
    AXISCAL_TRY(const Words w, read_words(block.text, block.line, state.parameters));
    auto checked = check_words(w, block.line, axis_letter_, plane_);
    if (!checked) return checked;
    const auto value = [&](char letter, double otherwise = 0) {
        const auto found = w.values.find(letter);
        return found == w.values.end() ? otherwise : found->second;
    };
    const auto whole = [&](char letter) { return static_cast<int>(std::lround(value(letter))); };
    state.feed_mm_per_min = value('f', state.feed_mm_per_min);
    if (w.g.contains(800)) state.motion.reset();
    for (const int g : {0, 10, 20, 30})
        if (w.g.contains(g)) state.motion = g;
    if (w.m.contains(640)) machine.set_digital(whole('p'), true);
    if (w.m.contains(650)) machine.set_digital(whole('p'), false);
    if (w.m.contains(670)) state.with_next_way = std::pair{whole('e'), value('q')};
    if (w.m.contains(680)) machine.set_analog(whole('e'), value('q'));
    const auto set_with_way = [&] {
        if (const auto word = std::exchange(state.with_next_way, std::nullopt))
            machine.set_analog(word->first, word->second);
    };
    if (w.m.contains(660)) {
        const int mode = whole('l');
        if (mode != 0 && mode != 3 && mode != 4)
            return at_line(block.line, "M66 knows L0, L3 (wait high) and L4 (wait low) here");
        const bool high = mode != 4;
        const bool came = mode == 0 || machine.wait_input(whole('p'), high, value('q'));
        state.parameters.values["5399"] = came ? (machine.input(whole('p')) ? 1 : 0) : -1;
    }
    if (w.g.contains(40)) machine.dwell(value('p'));
    if (!plane_.empty() && w.values.contains(plane_[0]) && w.values.contains(plane_[1])) {
        if (!state.motion || *state.motion == 0 || !(state.feed_mm_per_min > 0))
            return at_line(block.line, "a way in the plane needs G1, G2 or G3 and a feed");
        const bool arc = *state.motion > 10;
        set_with_way();
        machine.trace({{value(plane_[0]), value(plane_[1])},
                       arc,
                       *state.motion == 30,
                       {value(centre_letter(plane_[0])), value(centre_letter(plane_[1]))},
                       state.feed_mm_per_min,
                       static_cast<int>(std::lround(value('p', 1)))});
    } else if (w.values.contains(axis_letter_)) {
        if (!state.motion) return at_line(block.line, "an axis word without G0 or G1");
        if (*state.motion == 10 && !(state.feed_mm_per_min > 0))
            return at_line(block.line, "G1 with zero feed rate");
        set_with_way();
        machine.move(value(axis_letter_), *state.motion == 0 ? 0 : state.feed_mm_per_min);
    }
    state.ended = w.m.contains(20) || w.m.contains(300);
    return {};
}

Result<void>
LinuxcncProgram::execute(const Block& block, State& state, MachineActions& machine) const {
    switch (block.kind) {
    case Kind::words: return execute_words(block, state, machine);
    case Kind::assignments: return assign(block, state);
    case Kind::abort: return at_line(block.line, "the program aborts: " + block.text);
    case Kind::if_:
    case Kind::while_: return test(block, state);
    case Kind::elseif:
        if (state.seeking_arm) return test(block, state);
        return skip_to_endif(state), Result<void>{};
    case Kind::else_:
        if (!state.seeking_arm) skip_to_endif(state);
        state.seeking_arm = false;
        return {};
    case Kind::endif: state.seeking_arm = false; return {};
    case Kind::endwhile: state.next = block.jump; return {};
    }
    return {};
}

Result<void> LinuxcncProgram::run(MachineActions& machine) const {
    State state;
    while (state.next < blocks_.size() && !state.ended && !machine.stopped()) {
        const Block& block = blocks_[state.next++];
        machine.at_line(block.line);
        auto executed = execute(block, state, machine);
        if (!executed) return executed;
    }
    return {};
}

} // namespace axiscal::simulate
