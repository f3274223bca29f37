#pragma once
// The station file of a first certificate: what only the technician knows is asked for, the
// instruments come from what is plugged in, everything else has a default. Pure.

#include "drivers/plugged/candidates.hpp"

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// What could harm the machine or the result: nobody guesses it.
struct StationQuestion {
    std::string_view option; ///< of the command line, without its dashes
    std::string_view table, key;
    std::string_view words, example;
    enum class Form : std::uint8_t { text, number, list } form = Form::text;
    /// Asked only where this key has this answer; empty: always.
    std::string_view when_key = {}, when_answer = {};
    [[nodiscard]] std::string name() const { return std::string{table} + "." + std::string{key}; }
};
/// In the order of the station file.
std::span<const StationQuestion> station_questions();

/// By StationQuestion::name(), as a person writes it: "1000 mm".
using StationAnswers = std::map<std::string, std::string>;

/// Whether the question arises with what was answered so far.
bool is_asked(const StationQuestion& question, const StationAnswers& answers);

/// Its tables but the instruments.
std::string station_text(const StationAnswers& answers);

/// Why the station file would refuse this answer, beside the others; empty: it does not.
std::string complaint_about(const StationQuestion& question, const StationAnswers& answers);

/// One [[instrument]] with keys exchanged or added. A value is a TOML number, true or false as it
/// stands, else a text; of a label's number (serial) always a text. @param settings  key and value
std::string block_with(const std::string& block,
                       const std::vector<std::pair<std::string, std::string>>& settings);

/// Lines of a block that a person must look at: they hold an example.
std::vector<std::string> examples_in(const std::string& block);

} // namespace axiscal
