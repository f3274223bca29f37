// What the instruments need: one entry each, however many of its channels are silent.
#include "acquisition/live/to_do_parts.hpp"

#include "analysis/quantity/time.hpp"

#include <algorithm>
#include <utility>

namespace axiscal::to_do_parts {
namespace {

constexpr const char* look_at_cables =
    "Check the cables; 'axiscal devices' shows what is connected.";

/// What of an instrument matters here.
struct Part {
    bool used = false;           ///< by the open run, or by any that may be armed
    bool sees_faces = false;     ///< an autocollimator: on the way to the next face it sees none
    bool beam_lost = false;      ///< of its channel in use
    std::string silent_channels; ///< in use, without a fresh good value
    Fault silent_with = Fault::stale; ///< the first of them
};

/// An open run is measured by the axis' instrument or by the ballbar: the other may lie in its box.
bool is_needed(const ChannelView& channel, const StationStatus& status) {
    if (!channel.used || !status.run_open || !status.run) return channel.used;
    const bool circular = status.run->pass == name_of(TestKind::circular);
    return channel.role != (circular ? "axis" : "ballbar");
}

Fault fault_of(const ChannelView& channel) {
    if (channel.quality == name_of(Quality::signal_error)) return Fault::signal_error;
    return channel.role == "environment" ? Fault::environment_stale : Fault::stale;
}

void add_channel(const ChannelView& channel, bool reads_angle, Part& part) {
    part.used = true;
    if (reads_angle && channel.role == "axis") return void(part.sees_faces = true);
    if (channel.quality == name_of(Quality::beam_lost)) part.beam_lost = true;
    if (channel.value) return;
    if (part.silent_channels.empty()) part.silent_with = fault_of(channel);
    part.silent_channels += (part.silent_channels.empty() ? "" : ", ") + channel.name;
}

Part part_of(const InstrumentView& instrument, const StationStatus& status) {
    Part part;
    for (const ChannelView& channel : status.channels)
        if (channel.instrument == instrument.name && is_needed(channel, status))
            add_channel(channel, status.axis.reads_angle, part);
    return part;
}

/// Such an instrument holds up an open run, and spoils the next one.
ToDoRank rank_of(const Part& part, bool run_open) {
    if (!part.used) return ToDoRank::note;
    return run_open ? ToDoRank::stop : ToDoRank::look;
}

std::string since_of(const InstrumentView& instrument) {
    return instrument.since_utc_ns == 0 ? "" : iso8601_utc(instrument.since_utc_ns);
}

ToDo plays_tape(const InstrumentView& instrument) {
    return {"instrument/" + instrument.name,
            ToDoRank::look,
            ToDoSource::instrument,
            instrument.name + " plays the tape " + instrument.tape +
                " and is no instrument: a station with a tape cannot measure",
            since_of(instrument),
            "Remove the line `tape` from the station file and restart axiscald",
            {},
            {}};
}

/// Not there, or without a good value for ten seconds.
ToDo in_trouble(const InstrumentView& instrument, const Part& part, bool run_open) {
    Divided words = divided(instrument.last_fault, instrument.last_note);
    if (words.next.empty()) words.next = look_at_cables;
    return {"instrument/" + instrument.name,
            rank_of(part, run_open),
            ToDoSource::instrument,
            instrument.name + ": " + std::string{name_of(instrument.state)} +
                (words.seen.empty() ? "" : ", " + words.seen),
            since_of(instrument),
            std::move(words.next),
            "axiscal devices",
            {}};
}

ToDo without_beam(const InstrumentView& instrument, bool run_open) {
    Divided words = divided(Fault::beam_lost);
    return {"instrument/" + instrument.name,
            run_open ? ToDoRank::stop : ToDoRank::look,
            ToDoSource::instrument,
            std::move(words.seen),
            {},
            std::move(words.next),
            run_open ? "" : "axiscal align",
            {}};
}

/// It still counts as available, and what it sends is too old or bad.
ToDo silent_in_part(const InstrumentView& instrument, const Part& part, bool run_open) {
    Divided words = divided(part.silent_with);
    if (words.next.empty()) words.next = look_at_cables;
    return {"instrument/" + instrument.name,
            rank_of(part, run_open),
            ToDoSource::instrument,
            instrument.name + " (" + part.silent_channels + "): " + words.seen,
            {},
            words.next,
            "axiscal devices",
            {}};
}

void add_instrument(const InstrumentView& instrument,
                    const StationStatus& status,
                    std::vector<ToDo>& list) {
    const Part part = part_of(instrument, status);
    const bool sees_no_face = part.sees_faces && instrument.state == InstrumentState::faulty;
    if (shown_state(instrument) == "tape")
        list.push_back(plays_tape(instrument));
    else if (part.beam_lost)
        list.push_back(without_beam(instrument, status.run_open));
    else if (instrument.state != InstrumentState::available && !sees_no_face)
        list.push_back(in_trouble(instrument, part, status.run_open));
    else if (instrument.state == InstrumentState::available && !part.silent_channels.empty())
        list.push_back(silent_in_part(instrument, part, status.run_open));
}

void add_due_thing(const std::string& name, const std::string& due_on, std::vector<ToDo>& list) {
    list.push_back({"due/" + name,
                    ToDoRank::look,
                    ToDoSource::instrument,
                    name + " was due for calibration on " + due_on,
                    {},
                    "Have it calibrated, or enter the new certificate.",
                    {},
                    {}});
}

bool is_past(const std::string& due_on, const std::string& utc) {
    return !due_on.empty() && due_on < utc.substr(0, due_on.size());
}

} // namespace

void add_instruments(const StationStatus& status, std::vector<ToDo>& list) {
    for (const InstrumentView& instrument : status.instruments)
        add_instrument(instrument, status, list);
}

void add_due(const StationStatus& status, std::vector<ToDo>& list) {
    for (const InstrumentView& instrument : status.instruments)
        if (is_past(instrument.due_on, status.utc) && part_of(instrument, status).used)
            add_due_thing(instrument.name, instrument.due_on, list);
    for (const ChannelView& channel : status.channels)
        if (channel.used && is_past(channel.due_on, status.utc))
            add_due_thing(channel.instrument + "/" + channel.channel, channel.due_on, list);
}

} // namespace axiscal::to_do_parts
