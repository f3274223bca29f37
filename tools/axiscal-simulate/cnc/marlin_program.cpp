#include "cnc/marlin_program.hpp"

#include "cnc/program_line.hpp"

#include <cctype>
#include <charconv>
#include <map>
#include <sstream>

namespace axiscal::simulate {

namespace {

Result<std::map<char, double>> read_words(std::istringstream& text, int line) {
    std::map<char, double> words;
    for (std::string word; text >> word;) {
        const char letter =
            static_cast<char>(std::toupper(static_cast<unsigned char>(word.front())));
        double value = 0;
        const char* end = word.data() + word.size();
        const auto read = std::from_chars(word.data() + 1, end, value);
        if (read.ec != std::errc{} || read.ptr != end)
            return at_line(line, "\"" + word + "\" is not a word with a number");
        words[letter] = value;
    }
    return words;
}

/// The first word that this command does not use.
Result<void> only(const std::map<char, double>& words, const std::string& letters, int line) {
    for (const auto& [letter, value] : words)
        if (letters.find(letter) == std::string::npos)
            return at_line(line, std::string{"the word "} + letter + " is not understood here");
    return {};
}

} // namespace

Result<void> MarlinProgram::add_line(const std::string& line, int number, char axis, double& feed) {
    std::istringstream text{line.substr(0, line.find(';'))};
    std::string command;
    if (!(text >> command)) return {};
    if (command == "M117") {
        std::string message;
        std::getline(text >> std::ws, message);
        steps_.push_back({Step::message, number, 0, 0, message});
        return {};
    }
    AXISCAL_TRY(auto words, read_words(text, number));
    if (command == "G21" || command == "G90" || command == "M400") return only(words, "", number);
    if (command == "M84") { // S0: motors stay on
        return words['S'] == 0 ? only(words, "S", number)
                               : at_line(number, "M84 takes the motors off the axis");
    }
    if (command == "G4") {
        const double seconds = words.contains('S') ? words['S'] : words['P'] / 1000.0;
        steps_.push_back({Step::dwell, number, seconds, 0});
        return only(words, "PS", number);
    }
    if (command != "G0" && command != "G1") return at_line(number, command + " is not understood");
    if (words.contains('F')) feed = words['F'];
    if (!(feed > 0)) return at_line(number, "a move without a feed rate (F)");
    if (words.contains(axis)) steps_.push_back({Step::move, number, words[axis], feed});
    return only(words, std::string{"F"} + axis, number);
}

Result<MarlinProgram> MarlinProgram::parse(const std::string& text, char axis_letter) {
    MarlinProgram program;
    const char axis = static_cast<char>(std::toupper(static_cast<unsigned char>(axis_letter)));
    std::istringstream lines{text};
    double feed = 0;
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        auto added = program.add_line(line, ++number, axis, feed);
        if (!added) return tl::unexpected<Error>(added.error());
    }
    return program;
}

Result<void> MarlinProgram::run(MachineActions& machine) const {
    for (const Step& step : steps_) {
        if (machine.stopped()) break;
        machine.at_line(step.line);
        switch (step.kind) {
        case Step::move: machine.move(step.value, step.feed_mm_per_min); break;
        case Step::dwell: machine.dwell(step.value); break;
        case Step::message: machine.message(step.text); break;
        }
    }
    return {};
}

} // namespace axiscal::simulate
