#include "acquisition/journal/missing_rows.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace axiscal {
namespace {

constexpr std::array singles{"run", "plan", "laser", "material", "air"}; // exactly one row each
constexpr int most_steps = 100'000;                 // a wrong number is no reason to count to it
constexpr std::string_view first_of_body = "datum"; // tables from here on are written in the run

std::size_t place_of(std::string_view table) {
    return static_cast<std::size_t>(&table_named(table) - chained_tables().data());
}

std::string text_at(const Row& row, std::size_t column) {
    const auto* text = column < row.size() ? std::get_if<std::string>(&row[column]) : nullptr;
    return text ? *text : std::string{};
}

int number_at(const Row& row, std::size_t column) {
    const auto* number = column < row.size() ? std::get_if<std::int64_t>(&row[column]) : nullptr;
    return number ? static_cast<int>(std::clamp<std::int64_t>(*number, -1, most_steps)) : -1;
}

/// "Skipped: planned step 7"; -1 for any other event.
int skipped_by(const Row& event) {
    const std::string text = text_at(event, 3);
    const auto space = text.rfind(' ');
    if (text_at(event, 0) != "skipped" || space == std::string::npos) return -1;
    int step = -1;
    std::from_chars(text.data() + space + 1, text.data() + text.size(), step);
    return step;
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
    return text;
}

} // namespace

std::int64_t MissingRows::count_of(std::string_view table) const {
    const auto found = counts_.find(table);
    return found == counts_.end() ? 0 : found->second;
}

void MissingRows::hole(std::int64_t link) {
    holes_.push_back({{link, {}, {}}, last_table_, chained_tables().size()});
    after_hole_ = !due_synchronisation_;
    if (!due_synchronisation_) return;
    holes_.back().row.table = "synchronisation";
    holes_.back().row.about = "step=" + std::to_string(*due_synchronisation_);
    due_synchronisation_.reset();
}

void MissingRows::see(const Table& table, const Row& row) {
    const std::size_t place = place_of(table.name);
    for (auto hole = holes_.rbegin(); hole != holes_.rend(); ++hole) {
        if (hole->after != chained_tables().size()) break;
        hole->after = place;
    }
    last_table_ = place;
    due_synchronisation_.reset();
    if (table.name == "synchronisation") see_synchronisation(row);
    after_hole_ = false;
    if (format_ >= 4 && table.name == "datum") due_synchronisation_ = -1;
    if (format_ >= 4 && table.name == "point") due_synchronisation_ = number_at(row, 0);
    ++counts_[std::string{table.name}];
    if (table.name == "plan") rotary_axis_ = text_at(row, 0) == "rotary";
    if (table.name == "plan_point") {
        planned_.insert(number_at(row, 0));
        targets_ = std::max(targets_, number_at(row, 1) + 1);
    }
    if (table.name == "laser") referred_instruments_.insert(text_at(row, 0));
    if (table.name == "statement") statements_.insert(text_at(row, 0));
    if (table.name == "instrument") instruments_.insert(text_at(row, 0));
    if (table.name == "channel") {
        channels_.insert(number_at(row, 0));
        referred_instruments_.insert(text_at(row, 2));
    }
    if (table.name == "datum") datums_.insert(text_at(row, 0));
    if (table.name == "environment") referred_channels_.insert(number_at(row, 0));
    if (table.name == "event") accounted_.insert(skipped_by(row));
    if (table.name == "point") see_point(row);
    if (table.name == "closing" && number_at(row, 0) == 1)
        settle_points(static_cast<int>(planned_.size()));
}

/// The row before it is the point or the datum that it belongs to.
void MissingRows::see_synchronisation(const Row& row) {
    if (!after_hole_ || holes_.empty() || !holes_.back().row.table.empty()) return;
    MissingRow& missing = holes_.back().row;
    const int step = number_at(row, 0);
    missing.table = step < 0 ? "datum" : "point";
    missing.about = step < 0 ? "id=" + text_at(row, 1) : "step=" + std::to_string(step);
    if (step < 0) datums_.insert(text_at(row, 1));
    accounted_.insert(step);
}

void MissingRows::see_point(const Row& row) {
    const std::string datum = text_at(row, 15);
    if (datums_.insert(datum).second) // nobody tied what this point refers to
        for (Hole& hole : holes_)
            if (hole.row.table.empty() && hole.after >= place_of(first_of_body)) {
                hole.row.table = "datum", hole.row.about = "id=" + datum;
                break;
            }
    const int step = number_at(row, 0);
    settle_points(step);
    last_step_ = std::max(last_step_, step);
    in_question_ = holes_.size();
}

/// The holes since the last point are the steps that were passed over, where they are as many.
void MissingRows::settle_points(int next_step) {
    std::vector<int> missed;
    for (int step = last_step_ + 1; step < next_step; ++step)
        if (!accounted_.contains(step)) missed.push_back(step);
    std::vector<Hole*> open;
    for (std::size_t i = in_question_; i < holes_.size(); ++i)
        if (holes_[i].row.table.empty() && holes_[i].after >= place_of(first_of_body))
            open.push_back(&holes_[i]);
    if (missed.empty()) return;
    for (std::size_t i = 0; i < open.size(); ++i) {
        const bool certain = missed.size() >= open.size();
        open[i]->row.table = certain        ? "point"
                             : format_ >= 4 ? "point, synchronisation, environment or event"
                                            : "point, environment or event";
        open[i]->row.about = "step=" + std::to_string(missed[std::min(i, missed.size() - 1)]);
    }
}

void MissingRows::gather_header_evidence() {
    for (const char* table : singles)
        if (count_of(table) == 0) miss(table, "");
    if (count_of("plan_target") < targets_) miss("plan_target", "");
    const int steps = planned_.empty() ? 0 : *planned_.rbegin() + 1;
    for (int step = 0; step < steps; ++step)
        if (!planned_.contains(step)) miss("plan_point", "step=" + std::to_string(step));
    for (const ChainedRow& row : header_rows({}))
        if (row.table->name == "statement" && !statements_.contains(text_at(row.row, 0)))
            miss("statement", "name=" + text_at(row.row, 0));
    if (count_of("uncertainty") == 0 && count_of("uncertainty_target") > 0) miss("uncertainty", "");
    if (count_of("rotary") == 0 && count_of("rotary_deviation") > 0) miss("rotary", "");
    if (count_of("alignment") == 0 && count_of("alignment_place") > 0) miss("alignment", "");
    for (const std::string& name : referred_instruments_)
        if (!instruments_.contains(name)) miss("instrument", "name=" + name);
    referred_channels_.insert(channels_.empty() ? 0 : *channels_.rbegin());
    for (int id = 0; id <= *referred_channels_.rbegin(); ++id)
        if (!channels_.contains(id)) miss("channel", "id=" + std::to_string(id));
}

void MissingRows::settle_header(Hole& hole) {
    const std::size_t body = place_of(first_of_body);
    const std::size_t last = std::min(hole.after, body - 1);
    const auto fits = [&](const auto& known) {
        const std::size_t place = place_of(known.first);
        return place >= hole.before && place <= last;
    };
    if (const auto known = std::ranges::find_if(evidence_, fits); known != evidence_.end()) {
        hole.row.table = known->first, hole.row.about = known->second;
        evidence_.erase(known);
        return;
    }
    std::vector<std::string> candidates;
    for (std::size_t place = hole.before; place <= last; ++place) {
        const std::string name{chained_tables()[place].name};
        // Tables of later formats, which most runs leave empty.
        if (name.starts_with("alignment") && count_of("alignment") == 0) continue;
        if (name.starts_with("channel_") && count_of("channel_calibration") == 0) continue;
        if (name.starts_with("rotary") && !rotary_axis_) continue;
        if (name.starts_with("probing") && count_of("probing") == 0) continue;
        const bool single = name == "uncertainty" || name == "statement" ||
                            std::ranges::find(singles, name) != singles.end();
        if (!single || count_of(name) == 0) candidates.push_back(name);
    }
    if (hole.after >= body) candidates.insert(candidates.end(), {"environment", "event"});
    hole.row.table = joined(candidates);
}

std::vector<MissingRow> MissingRows::result() {
    if (!holes_.empty()) gather_header_evidence();
    std::vector<MissingRow> rows;
    rows.reserve(holes_.size());
    const std::size_t body = place_of(first_of_body);
    for (Hole& hole : holes_) {
        if (hole.row.table.empty() && hole.before < body) settle_header(hole);
        if (hole.row.table.empty())
            hole.row.table =
                datums_.empty() ? "datum, environment or event" : "environment or event";
        rows.push_back(hole.row);
    }
    return rows;
}

} // namespace axiscal
