#pragma once
// The newest event of each topic as text, made once for all clients of GET /v1/events. No I/O.

#include "acquisition/console/event_stream.hpp"
#include "acquisition/live/station_interface.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace axiscal {

/// Loop-bound. A frame stays as it is while somebody sends it.
class EventFrames {
public:
    using Frame = std::shared_ptr<const std::string>;

    /// @param daemon  as PointsId::daemon
    explicit EventFrames(std::uint64_t daemon) { points_id_.daemon = daemon; }

    // Each keeps what is new, and returns whether anything is.
    bool keep(const StationStatus& status);
    bool keep(std::size_t stretches, const std::optional<StreamView>& stream);
    /// @param shown  with the points from points_known() on, unless it begins_anew(): then with all
    bool keep(const PointsView& shown);
    /// Of another run, or what was sent of this one is no longer so: fewer points, or others that
    /// are excluded.
    [[nodiscard]] bool begins_anew(const PointsView& shown) const;
    void beat(const std::string& utc);

    [[nodiscard]] std::size_t points_known() const { return points_.size(); }
    [[nodiscard]] const PointsId& points_id() const { return points_id_; }

    [[nodiscard]] Frame status() const { return status_; }
    [[nodiscard]] Frame heartbeat() const { return heartbeat_; }
    [[nodiscard]] Frame stream(std::size_t stretches) const;
    /// All that a client which has `has` lacks; everything for one that has nothing of this run.
    [[nodiscard]] Frame points(const std::optional<PointsId>& has);
    /// Of streams that nobody asks for any more: a client may ask for each of 4096.
    void forget_streams_but(const std::set<std::size_t>& stretches);
    /// Nobody listens: what grows old is dropped. The points and their count stay.
    void forget();

private:
    struct Stream {
        StreamView shown; ///< without its stretches
        Frame frame;
    };
    struct Point {
        std::string json;
        int target = 0;
    };
    [[nodiscard]] std::string points_json(std::size_t from) const;
    [[nodiscard]] std::string targets_json(std::size_t from) const;

    Frame status_, heartbeat_;
    std::map<std::size_t, Stream> streams_; ///< by number of stretches
    std::string run_;
    std::vector<Point> points_;
    std::size_t excluded_ = 0;                   ///< of them
    std::string nominals_;                       ///< of the plan's targets, as JSON
    std::shared_ptr<const FiguresSoFar> so_far_; ///< of all of points_
    PointsId points_id_;
    std::size_t points_from_ = 0; ///< of the frame that was made last
    Frame points_frame_;
    std::uint64_t beats_ = 0;
};

} // namespace axiscal
