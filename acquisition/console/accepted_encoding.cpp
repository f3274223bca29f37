#include "acquisition/console/accepted_encoding.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>

namespace axiscal {
namespace {

constexpr int most_weight = 1000; // weights have at most three digits behind the point

struct WeighedCoding {
    std::string_view name;
    int weight = most_weight; ///< in thousandths; 0: must not be sent
};

std::string_view without_list_blanks(std::string_view text) {
    const auto begin = text.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

constexpr char small_letter(char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

/// The case of a coding does not count (RFC 9110, 8.4.1).
bool is_coding(std::string_view name, std::string_view small) {
    return std::ranges::equal(name, small, std::equal_to<>{}, small_letter);
}

/// A token of RFC 9110, 5.6.2, as `*` is one.
bool is_coding_name(std::string_view name) {
    const auto may_stand = [](char sign) {
        const char small = small_letter(sign);
        return (small >= 'a' && small <= 'z') || (sign >= '0' && sign <= '9') ||
               std::string_view{"!#$%&'*+-.^_`|~"}.find(sign) != std::string_view::npos;
    };
    return !name.empty() && std::ranges::all_of(name, may_stand);
}

/// "0.5" is 500. Nothing of what is no weight of RFC 9110, 12.4.2.
std::optional<int> thousandths_in(std::string_view text) {
    if (text.empty() || text.size() > 5 || (text.size() > 1 && text[1] != '.')) return {};
    if (text.front() != '0' && text.front() != '1') return {};
    int thousandths = text.front() == '1' ? most_weight : 0;
    int place = most_weight / 10;
    text.remove_prefix(std::min<std::size_t>(2, text.size()));
    for (const char digit : text) {
        if (digit < '0' || digit > '9') return {};
        thousandths += place * (digit - '0');
        place /= 10;
    }
    if (thousandths > most_weight) return {};
    return thousandths;
}

/// Of one member of the list. Nothing where it breaks the grammar.
std::optional<WeighedCoding> weighed_coding_of(std::string_view member) {
    const std::size_t end = std::min(member.find(';'), member.size());
    WeighedCoding coding{without_list_blanks(member.substr(0, end)), most_weight};
    if (!is_coding_name(coding.name)) return {};
    if (end == member.size()) return coding;
    const std::string_view weight = without_list_blanks(member.substr(end + 1));
    if (!weight.starts_with("q=") && !weight.starts_with("Q=")) return {};
    const std::optional<int> stated = thousandths_in(weight.substr(2));
    if (!stated) return {};
    coding.weight = *stated;
    return coding;
}

struct WeighedForms {
    std::optional<int> gzip, plain, others; ///< in thousandths, of those that are named

    /// Null for codings that the page has not.
    std::optional<int>* weight_of(std::string_view name) {
        if (is_coding(name, "gzip") || is_coding(name, "x-gzip")) return &gzip;
        if (is_coding(name, "identity")) return &plain;
        return name == "*" ? &others : nullptr;
    }

    /// Of one that is named twice the smaller weight counts: a refusal stays one.
    void take(const WeighedCoding& coding) {
        std::optional<int>* const weight = weight_of(coding.name);
        if (weight) *weight = std::min(weight->value_or(coding.weight), coding.weight);
    }
};

} // namespace

bool takes_gzip(std::string_view field) {
    WeighedForms forms;
    while (!field.empty()) {
        const std::size_t end = std::min(field.find(','), field.size());
        const std::string_view member = without_list_blanks(field.substr(0, end));
        field.remove_prefix(std::min(end + 1, field.size()));
        if (member.empty()) continue; // lists may have such (RFC 9110, 5.6.1)
        const std::optional<WeighedCoding> coding = weighed_coding_of(member);
        if (!coding) return false;
        forms.take(*coding);
    }
    const int others = forms.others.value_or(0);
    const int packed = forms.gzip.value_or(others);
    return packed > 0 && packed >= forms.plain.value_or(others);
}

} // namespace axiscal
