#include "cnc/expression.hpp"

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

namespace axiscal::simulate {

namespace {

struct Operator {
    std::string_view word;
    int level; ///< 0 binds least
    double (*apply)(double, double);
};

/// LinuxCNC compares within this tolerance.
constexpr double equal_within = 1e-6;

bool equal(double a, double b) {
    return std::abs(a - b) < equal_within;
}

constexpr int strongest = 4;
const std::array operators{
    Operator{"and", 0, [](double a, double b) { return a != 0 && b != 0 ? 1.0 : 0.0; }},
    Operator{"xor", 0, [](double a, double b) { return (a != 0) != (b != 0) ? 1.0 : 0.0; }},
    Operator{"or", 0, [](double a, double b) { return a != 0 || b != 0 ? 1.0 : 0.0; }},
    Operator{"eq", 1, [](double a, double b) { return equal(a, b) ? 1.0 : 0.0; }},
    Operator{"ne", 1, [](double a, double b) { return equal(a, b) ? 0.0 : 1.0; }},
    Operator{"gt", 1, [](double a, double b) { return a > b ? 1.0 : 0.0; }},
    Operator{"ge", 1, [](double a, double b) { return a >= b ? 1.0 : 0.0; }},
    Operator{"lt", 1, [](double a, double b) { return a < b ? 1.0 : 0.0; }},
    Operator{"le", 1, [](double a, double b) { return a <= b ? 1.0 : 0.0; }},
    Operator{"**", 4, [](double a, double b) { return std::pow(a, b); }},
    Operator{"+", 2, [](double a, double b) { return a + b; }},
    Operator{"-", 2, [](double a, double b) { return a - b; }},
    Operator{"*", 3, [](double a, double b) { return a * b; }},
    Operator{"/", 3, [](double a, double b) { return a / b; }},
    Operator{"mod", 3,
             [](double a, double b) {
                 const double rest = std::fmod(a, b);
                 return rest < 0 ? rest + std::abs(b) : rest;
             }},
};

struct Function {
    std::string_view word;
    double (*apply)(double);
};
const std::array functions{
    Function{"abs", [](double x) { return std::abs(x); }},
    Function{"fix", [](double x) { return std::floor(x); }},
    Function{"fup", [](double x) { return std::ceil(x); }},
    Function{"round", [](double x) { return std::round(x); }},
    Function{"sqrt", [](double x) { return std::sqrt(x); }},
};

} // namespace

void ExpressionReader::fail(const std::string& reason) {
    if (reason_.empty()) reason_ = reason;
}

bool ExpressionReader::take(char c) {
    if (next() != c || failed()) return false;
    text_.remove_prefix(1);
    return true;
}

bool ExpressionReader::take_word(std::string_view word) {
    if (!text_.starts_with(word) || failed()) return false;
    text_.remove_prefix(word.size());
    return true;
}

double ExpressionReader::number() {
    double value = 0;
    const char* begin = text_.data();
    const auto read = std::from_chars(begin, begin + text_.size(), value, std::chars_format::fixed);
    if (read.ec != std::errc{}) {
        fail("a number is missing before \"" + std::string{text_.substr(0, 12)} + "\"");
        return 0;
    }
    text_.remove_prefix(static_cast<std::size_t>(read.ptr - begin));
    return value;
}

std::string ExpressionReader::parameter_name() {
    if (next() == '<') {
        const auto end = text_.find('>');
        if (end == std::string_view::npos) return fail("a > is missing"), "";
        std::string name{text_.substr(0, end + 1)};
        text_.remove_prefix(end + 1);
        return name;
    }
    std::size_t digits = 0;
    while (digits < text_.size() && std::isdigit(static_cast<unsigned char>(text_[digits])) != 0)
        ++digits;
    if (digits == 0) return fail("a parameter number is missing after #"), "";
    std::string name{text_.substr(0, digits)};
    text_.remove_prefix(digits);
    return name;
}

double ExpressionReader::function() {
    for (const Function& f : functions) {
        if (!take_word(f.word)) continue;
        return f.apply(bracket());
    }
    return number();
}

double ExpressionReader::value() {
    if (take('-')) return -value();
    if (take('+')) return value();
    if (next() == '[') return bracket();
    if (!take('#')) return function();
    const std::string name = parameter_name();
    const auto found = parameters_.values.find(name);
    if (found != parameters_.values.end()) return found->second;
    const bool named = name.starts_with('<'); // a numbered one that was never set reads as 0
    if (parameters_.strict && named) fail("#" + name + " is not set");
    return 0;
}

double ExpressionReader::bracket() {
    if (!take('[')) return fail("a [ is missing"), 0;
    const double inner = binary(0);
    if (!take(']')) fail("a ] is missing before \"" + std::string{text_.substr(0, 12)} + "\"");
    return inner;
}

double ExpressionReader::binary(int level) {
    if (level > strongest) return value();
    double left = binary(level + 1);
    for (bool found = true; found && !failed();) {
        found = false;
        for (const Operator& op : operators) {
            const bool power_ahead = op.word == "*" && text_.starts_with("**");
            if (op.level != level || power_ahead || !take_word(op.word)) continue;
            left = op.apply(left, binary(level + 1));
            found = true;
            break;
        }
    }
    return left;
}

} // namespace axiscal::simulate
