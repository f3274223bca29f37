#include "tools/axiscal/cases/case_reader.hpp"

#include "config/measure.hpp"
#include "tools/axiscal/case_text.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace axiscal {

using nlohmann::json;

namespace {

/// Keys that carry words only and can change no figure.
constexpr std::array<std::string_view, 14> remark_keys{
    "comment", "customer", "date",     "description", "id",  "instrument", "machine",
    "name",    "note",     "operator", "place",       "run", "source",     "title"};

/// What a quantity was called before it had one name and one unit in every kind of case.
struct Renamed {
    std::string_view before, now;
};
constexpr std::array renamed_keys{
    Renamed{"alpha_um_per_m_K", "'expansion_per_K': 11.7 um/(m K) are 1.17e-5"},
    Renamed{"alpha_width_um_per_m_K", "'expansion_width_per_K': 2 um/(m K) are 2e-6"},
    Renamed{"device_alpha_um_per_m_K", "'device_expansion_per_K': 11.7 um/(m K) are 1.17e-5"},
    Renamed{"device_alpha_width_um_per_m_K", "'device_expansion_width_per_K': 2 um/(m K) are 2e-6"},
    Renamed{"machine_alpha_per_K", "'machine_expansion_per_K'"},
    Renamed{"bar_alpha_per_K", "'bar_expansion_per_K'"},
    Renamed{"machine_alpha_width_per_K", "'machine_expansion_width_per_K'"},
    Renamed{"bar_alpha_width_per_K", "'bar_expansion_width_per_K'"},
    Renamed{"feed_mm_per_s", "'feed_mm_per_min': 10 mm/s are 600"}};

/// Letters to insert, delete or replace to turn one word into the other, case aside.
std::size_t edit_distance(const std::string& a, const std::string& b) {
    const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        row[j] = j;
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (lower(a[i]) == lower(b[j]) ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

/// "a", "b"
std::string listed(const Words& words) {
    std::string list;
    for (const std::string& word : words)
        list += (list.empty() ? "\"" : ", \"") + word + '"';
    return list;
}

std::string hint_for(const std::string& key, const Words& known) {
    constexpr std::size_t longest_key = 32, near = 2;
    const auto renamed = std::ranges::find(renamed_keys, key, &Renamed::before);
    if (renamed != renamed_keys.end()) return "it is called " + std::string{renamed->now};
    if (key.size() <= longest_key)
        for (const std::string& word : known)
            if (edit_distance(key, word) <= near) return "did you mean '" + word + "'?";
    return "known here: " + listed(known) + "; remarks go under 'comment'";
}

} // namespace

Result<void> check_object(const json& object, const std::string& field, const Words& known) {
    if (!object.is_object())
        return refuse(Fault::bad_case, field.empty() ? "case" : field, "must be an object");
    const std::string prefix = field.empty() ? "" : field + ".";
    for (const auto& [key, value] : object.items()) {
        if (std::ranges::find(known, key) != known.end()) continue;
        if (std::ranges::find(remark_keys, key) != remark_keys.end()) continue;
        return refuse(Fault::bad_case, prefix + printable(key),
                      "is not a key of a case; " + hint_for(key, known));
    }
    return {};
}

Result<const json*> member(const json& object, const std::string& key, const std::string& field) {
    const auto found = object.find(key);
    if (found == object.end()) return refuse(Fault::bad_case, field, "is missing");
    return &*found;
}

Result<std::string> text_of(const json& object, const std::string& key, const std::string& field) {
    AXISCAL_TRY(const json* value, member(object, key, field));
    if (!value->is_string() || !not_finite_token(*value).empty())
        return refuse(Fault::bad_case, field, "must be a text");
    return value->get<std::string>();
}

Result<std::string>
one_of(const json& object, const std::string& key, const std::string& field, const Words& allowed) {
    const std::string must =
        (allowed.size() == 1 ? "must be " : "must be one of ") + listed(allowed);
    if (!object.contains(key)) return refuse(Fault::bad_case, field, "is missing; it " + must);
    AXISCAL_TRY(std::string word, text_of(object, key, field));
    if (std::ranges::find(allowed, word) != allowed.end()) return word;
    return refuse(Fault::bad_case, field, must + did_you_mean(word, allowed));
}

std::string indexed(const std::string& field, std::size_t index) {
    return field + "[" + std::to_string(index) + "]";
}

Result<double> number_of(const json& value, const std::string& field) {
    if (value.is_number()) return value.get<double>();
    if (const std::string token = not_finite_token(value); !token.empty())
        return refuse(Fault::bad_case, field, token + " is not a finite number");
    return refuse(Fault::bad_case, field,
                  std::string{"must be a number, not "} + value.type_name());
}

Result<double> number_at(const json& object, const std::string& key, const std::string& field) {
    AXISCAL_TRY(const json* value, member(object, key, field));
    return number_of(*value, field);
}

Result<double> positive_at(const json& object, const std::string& key, const std::string& field) {
    constexpr double largest_magnitude = 1e12; // beyond any machine in any unit
    AXISCAL_TRY(const double number, number_at(object, key, field));
    if (!(number > 0) || number > largest_magnitude)
        return refuse(Fault::bad_case, field, "must be greater than 0 and at most 1e12");
    return number;
}

Result<double>
number_or(const json& object, const std::string& key, const std::string& field, double missing) {
    return object.contains(key) ? number_at(object, key, field) : Result<double>{missing};
}

Result<std::vector<double>> numbers_of(const json& array, const std::string& field) {
    if (!array.is_array()) return refuse(Fault::bad_case, field, "must be an array of numbers");
    std::vector<double> numbers;
    numbers.reserve(array.size());
    for (std::size_t i = 0; i < array.size(); ++i) {
        if (array[i].is_number()) { // names of a million fields would cost more than the numbers
            numbers.push_back(array[i].get<double>());
            continue;
        }
        auto refused = number_of(array[i], indexed(field, i));
        return tl::unexpected(std::move(refused).error());
    }
    return numbers;
}

Result<std::vector<double>>
numbers_at(const json& object, const std::string& key, const std::string& field) {
    AXISCAL_TRY(const json* array, member(object, key, field));
    return numbers_of(*array, field);
}

Result<Rows> rows_of(const json& array, const std::string& field) {
    if (!array.is_array() || array.empty())
        return refuse(Fault::bad_case, field, "must be an array of one row a target");
    Rows rows;
    for (std::size_t i = 0; i < array.size(); ++i) {
        AXISCAL_TRY(auto row, numbers_of(array[i], indexed(field, i)));
        rows.push_back(std::move(row));
    }
    return rows;
}

} // namespace axiscal
