#pragma once
// Numbers, parameters and bracketed expressions of the LinuxCNC dialect. Pure.

#include "analysis/quantity/result.hpp"

#include <map>
#include <string>
#include <string_view>

namespace axiscal::simulate {

/// Numbered (#5399) and named (#<i>) parameters.
struct Parameters {
    std::map<std::string, double> values;
    /// Off while a program is only checked: a parameter that is not set yet reads as 0.
    bool strict = true;
};

/// Reads from the front of a text without blanks, in lower case. Errors keep the first reason.
class ExpressionReader {
public:
    ExpressionReader(std::string_view text, const Parameters& parameters)
        : text_{text}
        , parameters_{parameters} {}
    /// A number, #parameter, [expression] or function[...], with an optional sign.
    double value();
    /// The name after '#': "5399" or "<i>".
    std::string parameter_name();
    /// Takes this character if it stands next.
    bool take(char c);
    [[nodiscard]] char next() const { return text_.empty() ? '\0' : text_.front(); }
    [[nodiscard]] bool done() const { return text_.empty() || failed(); }
    [[nodiscard]] bool failed() const { return !reason_.empty(); }
    [[nodiscard]] const std::string& reason() const { return reason_; }
    [[nodiscard]] std::string_view rest() const { return text_; }
    void fail(const std::string& reason);

private:
    double bracket();
    double binary(int level);
    double number();
    double function();
    bool take_word(std::string_view word);
    std::string_view text_;
    const Parameters& parameters_;
    std::string reason_;
};

} // namespace axiscal::simulate
