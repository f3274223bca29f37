#include "acquisition/live/to_do.hpp"

#include "acquisition/live/to_do_parts.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <ranges>
#include <tuple>
#include <utility>

namespace axiscal {
namespace {

constexpr std::array<std::string_view, 3> rank_names{"stop", "look", "note"};
constexpr std::array<std::string_view, 9> source_names{
    "disk", "run", "trigger", "instrument", "clock", "preflight", "finding", "outbox", "doctor"};

std::string begun_large(std::string words) {
    if (!words.empty())
        words.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(words.front())));
    return words;
}

/// The same sentence is part of the other: one trouble, told by two of its witnesses.
bool tells_the_same(const ToDo& one, const ToDo& other) {
    return one.id == other.id || one.seen.find(other.seen) != std::string::npos ||
           other.seen.find(one.seen) != std::string::npos;
}

/// The earlier one stands, in the higher of their ranks.
void drop_repeated(std::vector<ToDo>& list) {
    std::vector<ToDo> kept;
    for (ToDo& entry : list) {
        const auto known = std::ranges::find_if(
            kept, [&](const ToDo& other) { return tells_the_same(entry, other); });
        if (known == kept.end())
            kept.push_back(std::move(entry));
        else
            known->rank = std::min(known->rank, entry.rank);
    }
    list = std::move(kept);
}

} // namespace

namespace to_do_parts {

Divided divided(Fault fault) {
    const std::string sentence{fault_sentence(fault)};
    const auto colon = sentence.find(": ");
    if (colon == std::string::npos) return {sentence, ""};
    return {sentence.substr(0, colon) + ".", begun_large(sentence.substr(colon + 2))};
}

Divided divided(Fault fault, const std::string& sentence) {
    const std::string_view whole = fault_sentence(fault);
    Divided parts = divided(fault);
    if (parts.next.empty() || !sentence.starts_with(whole)) return {sentence, parts.next};
    parts.seen += sentence.substr(whole.size());
    return parts;
}

Divided divided_at_order(const std::string& sentence) {
    const auto colon = sentence.find(": 'axiscal ");
    if (colon == std::string::npos) return {sentence, ""};
    return {sentence.substr(0, colon) + ".", sentence.substr(colon + 2)};
}

std::string told_at(const std::vector<std::string>& notes, std::string_view words) {
    for (const std::string& note : std::views::reverse(notes))
        if (!words.empty() && note.find(words) != std::string::npos)
            return note.substr(0, note.find(' '));
    return "";
}

} // namespace to_do_parts

std::string_view name_of(ToDoRank rank) {
    return rank_names[static_cast<std::size_t>(rank)];
}

std::string_view name_of(ToDoSource source) {
    return source_names[static_cast<std::size_t>(source)];
}

std::vector<ToDo> things_to_do(const StationStatus& status, const ToDoFacts& facts) {
    using namespace to_do_parts;
    std::vector<ToDo> list;
    add_disk(status, facts.disk, list);
    add_run(status, list);
    add_trigger(status, list);
    add_instruments(status, list);
    add_due(status, list);
    if (!status.run_open) add_checks(facts.judged, list);
    add_findings(status, facts.findings, list);
    add_drift(status, list);
    add_outbox(status.outbox, list);
    drop_repeated(list);
    std::ranges::stable_sort(list, {}, [](const ToDo& entry) {
        return std::tuple{entry.rank, entry.source};
    });
    return list;
}

std::string mend_or_override(const std::string& check) {
    return "Mend what fails, or arm with --override " + check +
           "=\"reason\": the certificate prints it.";
}

} // namespace axiscal
