#include "wire/vaisala_line.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>

namespace axiscal::simulate {

namespace {

/// The next modifier; text in quotation marks is one, with them.
std::string_view next_modifier(std::string_view& format) {
    format.remove_prefix(std::min(format.find_first_not_of(' '), format.size()));
    const bool quoted = format.starts_with('"');
    auto end = quoted ? format.find('"', 1) : format.find(' ');
    if (quoted && end != std::string_view::npos) ++end;
    const std::string_view word = format.substr(0, end);
    format.remove_prefix(word.size());
    return word;
}

std::string checksum(std::string_view modifier, std::string_view message) {
    unsigned sum = 0, exclusive = 0;
    for (const char letter : message) {
        const unsigned byte = static_cast<unsigned char>(letter);
        sum += byte;
        exclusive ^= byte;
    }
    char text[8];
    if (modifier == "CSX") std::snprintf(text, sizeof text, "%02X", exclusive & 0xFFU);
    if (modifier == "CS2") std::snprintf(text, sizeof text, "%02X", sum & 0xFFU);
    if (modifier == "CS4") std::snprintf(text, sizeof text, "%04X", sum & 0xFFFFU);
    return text;
}

/// Builds one message.
class Message {
public:
    explicit Message(const VaisalaAir& air)
        : air_{air} {}
    void add(std::string_view modifier);
    [[nodiscard]] const std::string& text() const { return text_; }

private:
    void quantity(double value, std::string_view unit);
    void unit_in(int places);

    VaisalaAir air_;
    std::string text_, unit_;
    int digits_ = 4, decimals_ = 1;
};

void Message::quantity(double value, std::string_view unit) {
    char number[32];
    const int width = digits_ + (decimals_ > 0 ? decimals_ + 1 : 0);
    std::snprintf(number, sizeof number, "%*.*f", width, decimals_, value);
    text_ += number;
    unit_ = unit;
}

void Message::unit_in(int places) {
    const auto wanted = static_cast<std::size_t>(places);
    text_ += unit_.substr(0, wanted);
    if (wanted > unit_.size()) text_.append(wanted - unit_.size(), ' ');
}

int number_in(std::string_view digits) {
    int number = 0; // of no digits, too
    std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return number;
}

void Message::add(std::string_view modifier) {
    if (modifier.starts_with('"') && modifier.size() >= 2)
        text_ += modifier.substr(1, modifier.size() - 2);
    else if (modifier == "P")
        quantity(air_.pressure_hPa, "hPa");
    else if (modifier == "T")
        quantity(air_.temperature_degC, "'C");
    else if (modifier == "RH")
        quantity(air_.humidity_percent, "%RH");
    else if (modifier == "CSX" || modifier == "CS2" || modifier == "CS4")
        text_ += checksum(modifier, text_);
    else if (modifier == "\\r")
        text_ += '\r';
    else if (modifier == "\\n")
        text_ += '\n';
    else if (modifier.starts_with('U'))
        unit_in(number_in(modifier.substr(1)));
    else if (const auto point = modifier.find('.'); point != std::string_view::npos) {
        digits_ = number_in(modifier.substr(0, point));
        decimals_ = number_in(modifier.substr(point + 1));
    }
}

bool begins(std::string_view command, std::string_view word) {
    return command.size() >= word.size() &&
           std::equal(word.begin(), word.end(), command.begin(),
                      [](char a, char b) { return (a | 0x20) == (b | 0x20); });
}

} // namespace

std::string vaisala_message(std::string_view format, const VaisalaAir& air) {
    Message message{air};
    for (auto word = next_modifier(format); !word.empty(); word = next_modifier(format))
        message.add(word);
    return message.text();
}

std::string VaisalaTransmitter::obey(const std::string& command, const VaisalaAir& air) {
    if (begins(command, "send")) return vaisala_message(format_, air);
    if (begins(command, "open")) return "PTU300: 1 line opened for operator commands\r\n";
    if (begins(command, "close")) return "line closed\r\n";
    if (begins(command, "form ")) {
        format_ = command.substr(5);
        return "OK\r\n";
    }
    return {};
}

std::string VaisalaTransmitter::answer(std::string& typed, const VaisalaAir& air) {
    std::string sent;
    for (auto end = typed.find('\r'); end != std::string::npos; end = typed.find('\r')) {
        const std::string command = typed.substr(0, end);
        typed.erase(0, end + 1);
        sent += command + "\r\n" + obey(command, air) + ">";
    }
    return sent;
}

} // namespace axiscal::simulate
