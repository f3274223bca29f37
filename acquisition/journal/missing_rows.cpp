// What each row tells of those that stood before it.
#include "acquisition/journal/missing_rows.hpp"

#include "acquisition/journal/missing_rows_words.hpp"

#include <algorithm>
#include <charconv>

namespace axiscal {
namespace {

/// "Skipped: planned step 7"; -1 for any other event.
int skipped_by(const Row& event) {
    const std::string text = text_at(event, 3);
    const auto space = text.rfind(' ');
    if (text_at(event, 0) != "skipped" || space == std::string::npos) return -1;
    int step = -1;
    std::from_chars(text.data() + space + 1, text.data() + text.size(), step);
    return step;
}

std::string about_step(int step) {
    return "step=" + std::to_string(step);
}

std::string about_block(int stream, int block) {
    return "stream=" + std::to_string(stream) + ", block=" + std::to_string(block);
}

} // namespace

std::int64_t MissingRows::count_of(std::string_view table) const {
    const auto found = counts_.find(table);
    return found == counts_.end() ? 0 : found->second;
}

void MissingRows::hole(std::int64_t link) {
    holes_.push_back({{link, {}, {}}, last_table_, chained_tables().size()});
    if (fresh_++ > 0) holes_.back().alone = holes_[holes_.size() - 2].alone = false;
    if (!due_) return;
    holes_.back().row.table = due_->table;
    holes_.back().row.about = due_->about;
    due_.reset();
}

void MissingRows::see(const Table& table, const Row& row) {
    for (Hole& hole : fresh())
        hole.after = place_of(table.name);
    due_.reset();
    if (table.name == "synchronisation" || table.name == "stream_block_time")
        see_second_of_pair(table, row);
    if (table.name == "retake_point") see_retake_point(row);
    if (format_ >= 4) see_first_of_pair(table, row);
    last_table_ = place_of(table.name);
    ++counts_[std::string{table.name}];
    fresh_ = 0;
    see_header(table, row);
    if (table.name == "datum") datums_.insert(text_at(row, 0));
    if (table.name == "environment") referred_channels_.insert(number_at(row, 0));
    if (table.name == "event") accounted_.insert(skipped_by(row));
    if (table.name == "point") see_point(row);
    if (table.name == "retake") retakes_ = std::max(retakes_, number_at(row, 0));
    if (table.name == "stream") streams_.insert(number_at(row, 0));
    if (table.name == "stream_block") referred_streams_.insert(number_at(row, 0));
    if (table.name == "closing" && number_at(row, 0) == 1)
        settle_points(static_cast<int>(planned_.size()));
}

void MissingRows::see_header(const Table& table, const Row& row) {
    if (table.name == "plan") {
        rotary_axis_ = text_at(row, 0) == "rotary";
        circular_pass_ = text_at(row, 2) == "circular";
    }
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
    if (table.name == "channel_calibration") calibrated_.insert(number_at(row, 0));
    if (table.name == "channel_correction") corrected_.insert(number_at(row, 0));
}

void MissingRows::see_first_of_pair(const Table& table, const Row& row) {
    if (table.name == "datum") due_ = MissingRow{0, "synchronisation", about_step(-1)};
    if (table.name == "point")
        due_ = MissingRow{0, "synchronisation", about_step(number_at(row, 0))};
    if (table.name == "stream_block")
        due_ =
            MissingRow{0, "stream_block_time", about_block(number_at(row, 0), number_at(row, 1))};
}

/// The row before it is the point, the datum or the block that it belongs to.
void MissingRows::see_second_of_pair(const Table& table, const Row& row) {
    if (fresh_ == 0 || !holes_.back().open()) return;
    MissingRow& missing = holes_.back().row;
    const int first = number_at(row, 0);
    if (table.name == "stream_block_time") {
        missing.table = "stream_block", missing.about = about_block(first, number_at(row, 1));
        referred_streams_.insert(first);
        return;
    }
    missing.table = first < 0 ? "datum" : "point";
    missing.about = first < 0 ? "id=" + text_at(row, 1) : about_step(first);
    if (first < 0) datums_.insert(text_at(row, 1));
    accounted_.insert(first);
}

/// An order and its points stand together, and their steps go on from those of the plan and of the
/// order before: as many points are missing as steps, and one row more is the order.
void MissingRows::see_retake_point(const Row& row) {
    const int step = number_at(row, 0);
    const int last = ordered_.empty() ? static_cast<int>(planned_.size()) - 1 : *ordered_.rbegin();
    const bool order_is_due =
        last_table_ != place_of("retake") &&
        (last_table_ != place_of("retake_point") || static_cast<int>(fresh_) > step - last - 1);
    int missed = step;
    for (auto hole = holes_.rbegin(); hole != holes_.rbegin() + std::ssize(fresh()); ++hole) {
        if (!hole->open()) break;
        if (--missed > last) {
            hole->row.table = "retake_point", hole->row.about = about_step(missed);
            ordered_.insert(missed);
            continue;
        }
        if (order_is_due)
            hole->row.table = "retake", hole->row.about = "number=" + std::to_string(++retakes_);
        break;
    }
    ordered_.insert(step);
}

/// Somebody ordered it: right after the order, or after its other points.
void MissingRows::see_ordered_point(int step, int planned_step) {
    if (step == planned_step || !ordered_.insert(step).second) return;
    for (Hole& hole : holes_)
        if (hole.open() && hole.before >= place_of("retake") &&
            hole.before <= place_of("retake_point")) {
            hole.row.table = "retake_point", hole.row.about = about_step(step);
            return;
        }
}

void MissingRows::see_point(const Row& row) {
    const std::string datum = text_at(row, 15);
    if (datums_.insert(datum).second) // nobody tied what this point refers to
        for (Hole& hole : holes_)
            if (hole.open() && hole.after >= place_of(first_of_body)) {
                hole.row.table = "datum", hole.row.about = "id=" + datum;
                break;
            }
    const int step = number_at(row, 0);
    see_ordered_point(step, number_at(row, 2));
    settle_points(step);
    last_step_ = std::max(last_step_, step);
    in_question_ = holes_.size();
}

/// The holes since the last point are the steps that were passed over, where they are as many. From
/// format 4 on no point is missing alone: its row of synchronisation would tell.
void MissingRows::settle_points(int next_step) {
    std::vector<int> missed;
    for (int step = last_step_ + 1; step < next_step; ++step)
        if (!accounted_.contains(step)) missed.push_back(step);
    std::vector<Hole*> open;
    for (std::size_t i = in_question_; i < holes_.size(); ++i)
        if (holes_[i].open() && holes_[i].after >= place_of(first_of_body) &&
            (format_ < 4 || !holes_[i].alone))
            open.push_back(&holes_[i]);
    if (missed.empty()) return;
    for (std::size_t i = 0; i < open.size(); ++i) {
        const bool certain = missed.size() >= open.size();
        open[i]->row.table = certain ? "point"
                             : format_ >= 7
                                 ? "point, synchronisation, environment, event, exclusion or ordered"
                             : format_ >= 4
                                 ? "point, synchronisation, environment, event or exclusion"
                                 : "point, environment or event";
        open[i]->row.about = about_step(missed[std::min(i, missed.size() - 1)]);
    }
}

} // namespace axiscal
