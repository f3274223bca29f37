// What the whole file tells of the rows that are missing.
#include "acquisition/journal/missing_rows.hpp"

#include "acquisition/journal/missing_rows_words.hpp"

#include <algorithm>
#include <array>

namespace axiscal {
namespace {

constexpr std::array singles{"run", "plan", "laser", "material", "air"}; // exactly one row each
// In this order, right behind each other, and the streams after them.
constexpr std::array circular_setup{"circular", "circular_bar", "circular_uncertainty",
                                    "circular_start"};

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
    return text;
}

} // namespace

bool MissingRows::is_circular() const {
    return circular_pass_ || !streams_.empty() ||
           std::ranges::any_of(circular_setup, [this](const char* t) { return count_of(t) > 0; });
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
    for (const std::string& name : referred_instruments_)
        if (!instruments_.contains(name)) miss("instrument", "name=" + name);
    referred_channels_.insert(channels_.empty() ? 0 : *channels_.rbegin());
    for (int id = 0; id <= *referred_channels_.rbegin(); ++id)
        if (!channels_.contains(id)) miss("channel", "id=" + std::to_string(id));
    gather_evidence_of_optional_tables();
}

/// Rows that belong to one tell of it; a run is a positioning, circular, probing or drift test.
void MissingRows::gather_evidence_of_optional_tables() {
    if (count_of("uncertainty") == 0 && count_of("uncertainty_target") > 0) miss("uncertainty", "");
    if (count_of("rotary") == 0 && count_of("rotary_deviation") > 0) miss("rotary", "");
    if (count_of("linear_scale") == 0 && count_of("linear_scale_sensor") > 0)
        miss("linear_scale", "");
    for (const int channel : corrected_)
        if (!calibrated_.contains(channel))
            miss("channel_calibration", "channel=" + std::to_string(channel));
    if (count_of("alignment") == 0 && count_of("alignment_place") > 0) miss("alignment", "");
    const bool probing = count_of("probing") + count_of("probing_touch") > 0;
    if (count_of("probing") == 0 && probing) miss("probing", "");
    const bool positioning = count_of("plan_target") > 0 || !planned_.empty();
    if (format_ >= 3 && !positioning && !probing && !is_circular() && count_of("drift") == 0)
        miss("drift", "");
}

/// Whether a row of that table can have stood there, as far as the rest of the file tells.
bool MissingRows::fits_header(const Hole& hole, std::string_view name) const {
    const auto belongs_to = [&](std::string_view owner) {
        return name.starts_with(owner) && name != owner;
    };
    for (const std::string_view owner :
         {"uncertainty", "rotary", "linear_scale", "alignment", "probing"}) {
        if (name == owner && count_of(owner) > 0) return false;
        if (belongs_to(owner) && count_of(owner) == 0 && hole.alone) return false;
    }
    if (name == "channel_correction" && calibrated_.empty() && hole.alone) return false;
    if (name.starts_with("rotary") && !rotary_axis_) return false;
    if (name.starts_with("linear_scale") && rotary_axis_) return false;
    if (name == "linear_scale" && hole.alone) return false; // its sensors would tell
    if (name == "drift" || name.starts_with("probing"))
        return count_of("drift") == 0 && count_of("plan_target") == 0 && !is_circular();
    if (name == "eve_source")
        return count_of(name) == 0 && (count_of("uncertainty") > 0 || is_circular());
    const bool single = name == "statement" || std::ranges::find(singles, name) != singles.end();
    return !single || count_of(name) == 0;
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
        const Table& table = chained_tables()[place];
        if (table.since <= format_ && fits_header(hole, table.name))
            candidates.emplace_back(table.name);
    }
    if (hole.after >= body)
        std::ranges::move(body_candidates(hole), std::back_inserter(candidates));
    hole.row.table = joined(candidates);
}

/// The setup of a circular test and its streams, by the rows they stand between.
void MissingRows::settle_streams() {
    if (!is_circular()) return;
    const std::size_t first = place_of(circular_setup.front()), last = place_of("stream");
    const auto within = [&](std::size_t place) { return place >= first && place <= last; };
    const auto settle = [&](std::string_view table, const std::string& about) {
        const std::size_t place = place_of(table);
        for (Hole& hole : holes_)
            if (hole.open() && ((within(hole.before) && hole.before <= place) ||
                                (within(hole.after) && hole.after >= place))) {
                hole.row.table = table, hole.row.about = about;
                return;
            }
    };
    for (const std::string_view table : circular_setup)
        if (count_of(table) == 0 && table_named(table).since <= format_) settle(table, "");
    referred_streams_.insert(streams_.empty() ? 0 : *streams_.rbegin());
    for (int id = 0; id <= *referred_streams_.rbegin(); ++id)
        if (!streams_.contains(id)) settle("stream", "id=" + std::to_string(id));
}

/// All tables of the body of which a row can have stood there.
std::vector<std::string> MissingRows::body_candidates(const Hole& hole) const {
    const auto beside = [&](std::string_view table) {
        return hole.before == place_of(table) || hole.after == place_of(table);
    };
    std::vector<std::string> tables;
    const auto add = [&](bool possible, const char* table) {
        if (possible) tables.emplace_back(table);
    };
    const bool pair = format_ < 4 || !hole.alone;
    add(beside("preflight") || (!hole.alone && format_ >= 3), "preflight");
    if (beside("preflight") && hole.before == hole.after) return tables;
    add(datums_.empty() && !is_circular(), "datum");
    add(pair && last_step_ >= 0, "point");
    add(format_ >= 4 && !hole.alone && last_step_ >= 0, "synchronisation");
    add(true, "environment");
    add(true, "event");
    add(pair && !streams_.empty(), "stream_block");
    add(format_ >= 4 && !hole.alone && !streams_.empty(), "stream_block_time");
    add(format_ >= 3 && !hole.alone && last_step_ >= 0, "retake");
    add(hole.before == place_of("retake_point") || (format_ >= 3 && !hole.alone && last_step_ >= 0),
        "retake_point");
    add(format_ >= 3 && last_step_ >= 0, "exclusion");
    add(format_ >= 7, "ordered");
    add(hole.after == place_of("retake") || hole.after == place_of("exclusion"), "closing");
    return tables;
}

void MissingRows::settle_body(Hole& hole) {
    if (hole.before == place_of("retake")) { // no order is without its points
        hole.row.table = "retake_point";
        return;
    }
    if (hole.before == place_of("closing") && hole.alone) { // an order alone would be told by these
        hole.row.table = format_ >= 7 ? "exclusion or ordered" : "exclusion";
        return;
    }
    hole.row.table = joined(body_candidates(hole));
}

std::vector<MissingRow> MissingRows::result() {
    if (!holes_.empty()) gather_header_evidence();
    settle_streams();
    std::vector<MissingRow> rows;
    rows.reserve(holes_.size());
    const std::size_t body = place_of(first_of_body);
    for (Hole& hole : holes_) {
        if (hole.open() && hole.before < body) settle_header(hole);
        if (hole.open()) settle_body(hole);
        rows.push_back(hole.row);
    }
    return rows;
}

} // namespace axiscal
