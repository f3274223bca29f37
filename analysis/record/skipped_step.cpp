#include "analysis/record/skipped_step.hpp"

#include <charconv>
#include <string_view>

namespace axiscal {

constexpr std::string_view skip_words = "Skipped: planned step ";

std::string skip_text(int step) {
    return std::string{skip_words} + std::to_string(step);
}

std::optional<int> skipped_step(const EventRecord& event) {
    if (event.kind != EventKind::skipped || !event.text.starts_with(skip_words))
        return std::nullopt;
    const std::string_view digits = std::string_view{event.text}.substr(skip_words.size());
    int step = -1; // stays where no number stands
    std::from_chars(digits.data(), digits.data() + digits.size(), step);
    return step >= 0 ? std::optional{step} : std::nullopt;
}

} // namespace axiscal
