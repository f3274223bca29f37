#include "acquisition/console/event_frames.hpp"

#include "acquisition/console/api_json.hpp"
#include "acquisition/console/so_far_json.hpp"
#include "acquisition/console/stream_json.hpp"
#include "config/json_text.hpp"

#include <nlohmann/json.hpp>

#include <utility>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

EventFrames::Frame frame_of(std::string text) {
    return std::make_shared<const std::string>(std::move(text));
}

std::string shown_point_json(const ShownPoint& point) {
    const Json shown = {{"step", point.step},
                        {"target", point.planned.target_index},
                        {"nominal_mm", point.nominal.in(mm)},
                        {"direction", name_of(point.planned.direction)},
                        {"approach", point.planned.approach},
                        {"deviation_um", point.deviation.in(um)},
                        {"excluded", point.excluded},
                        {"sequence", point.sequence}};
    return json_text(shown);
}

std::string nominals_json(const std::vector<Length>& targets) {
    Json nominals = Json::array();
    for (const Length target : targets)
        nominals.push_back(target.in(mm));
    return json_text(nominals);
}

StreamView without_stretches(const std::optional<StreamView>& stream) {
    if (!stream) return {};
    StreamView bare = *stream;
    bare.stretches.clear();
    return bare;
}

/// What was sampled cannot differ where its count does not.
bool is_same_stream(const StreamView& a, const StreamView& b) {
    return a.run_id == b.run_id && a.samples == b.samples && a.recording == b.recording &&
           a.gaps == b.gaps && a.missing == b.missing && a.rate_hz == b.rate_hz;
}

} // namespace

bool EventFrames::keep(const StationStatus& status) {
    std::string text = event_text("status", json_text(to_json(status)));
    if (status_ && *status_ == text) return false;
    status_ = frame_of(std::move(text));
    return true;
}

bool EventFrames::keep(std::size_t stretches, const std::optional<StreamView>& stream) {
    Stream& kept = streams_[stretches];
    StreamView shown = without_stretches(stream);
    if (kept.frame && is_same_stream(kept.shown, shown)) return false;
    kept.shown = std::move(shown);
    kept.frame = frame_of(event_text("stream", json_text(to_json(stream))));
    return true;
}

bool EventFrames::begins_anew(const PointsView& shown) const {
    const bool first_look = points_id_.run == 0;
    return first_look || shown.run_id != run_ || shown.count < points_.size() ||
           shown.excluded != excluded_;
}

bool EventFrames::keep(const PointsView& shown) {
    const bool anew = begins_anew(shown);
    if (!anew && shown.count == points_.size()) return false;
    if (anew) {
        run_ = shown.run_id;
        excluded_ = shown.excluded;
        nominals_ = nominals_json(shown.targets);
        points_.clear();
        ++points_id_.run;
    }
    for (const ShownPoint& point : shown.points)
        points_.push_back({shown_point_json(point), point.planned.target_index});
    so_far_ = shown.so_far;
    points_id_.points = points_.size();
    points_frame_ = nullptr;
    return true;
}

void EventFrames::beat(const std::string& utc) {
    const Json shown = {{"utc", utc}, {"count", ++beats_}};
    heartbeat_ = frame_of(event_text("heartbeat", json_text(shown)));
}

EventFrames::Frame EventFrames::stream(std::size_t stretches) const {
    const auto found = streams_.find(stretches);
    return found == streams_.end() ? nullptr : found->second.frame;
}

EventFrames::Frame EventFrames::points(const std::optional<PointsId>& has) {
    const bool of_this_run = has && has->daemon == points_id_.daemon &&
                             has->run == points_id_.run && has->points <= points_.size();
    const std::size_t from = of_this_run ? static_cast<std::size_t>(has->points) : 0;
    if (points_frame_ && points_from_ == from) return points_frame_;
    points_from_ = from;
    points_frame_ = frame_of(event_text("points", points_json(from), text_of(points_id_)));
    return points_frame_;
}

std::string EventFrames::points_json(std::size_t from) const {
    const Json run = run_.empty() ? Json(nullptr) : Json(run_);
    std::string text = "{\"run\":" + json_text(run) +
                       ",\"count\":" + std::to_string(points_.size()) +
                       ",\"from\":" + std::to_string(from);
    if (from == 0) text += ",\"target_nominals_mm\":" + nominals_;
    text += ",\"points\":[";
    for (std::size_t nth = from; nth < points_.size(); ++nth)
        text += (nth == from ? "" : ",") + points_[nth].json;
    return text + "],\"targets\":" + targets_json(from) + "}";
}

/// Only a target of which a point is sent has another mean than before.
std::string EventFrames::targets_json(std::size_t from) const {
    std::set<int> sent;
    for (std::size_t nth = from; nth < points_.size(); ++nth)
        sent.insert(points_[nth].target);
    Json rows = Json::array();
    if (!so_far_) return json_text(rows);
    for (const int target : sent)
        rows.push_back(target_json(target, so_far_->targets[static_cast<std::size_t>(target)]));
    return json_text(rows);
}

void EventFrames::forget_streams_but(const std::set<std::size_t>& stretches) {
    std::erase_if(streams_, [&](const auto& kept) { return !stretches.contains(kept.first); });
}

void EventFrames::forget() {
    status_ = heartbeat_ = nullptr;
    streams_.clear();
    points_frame_ = nullptr;
}

} // namespace axiscal
