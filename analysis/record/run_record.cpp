#include "analysis/record/run_record.hpp"

#include <algorithm>

namespace axiscal {

std::string_view name_of(AxisKind kind) {
    return kind == AxisKind::linear ? "linear" : "rotary";
}
std::string_view name_of(Direction direction) {
    return direction == Direction::positive ? "positive" : "negative";
}
std::string_view name_of(CycleKind kind) {
    return kind == CycleKind::standard ? "standard" : "step";
}

std::string_view name_of(TriggerOrigin origin) {
    switch (origin) {
    case TriggerOrigin::cnc: return "cnc";
    case TriggerOrigin::dwell: return "dwell";
    case TriggerOrigin::manual: return "manual";
    }
    return "?";
}

std::string_view name_of(ChannelKind kind) {
    switch (kind) {
    case ChannelKind::displacement: return "displacement";
    case ChannelKind::temperature: return "temperature";
    case ChannelKind::pressure: return "pressure";
    case ChannelKind::humidity: return "humidity";
    case ChannelKind::carbon_dioxide: return "carbon_dioxide";
    case ChannelKind::strength: return "strength";
    case ChannelKind::angle: return "angle";
    }
    return "?";
}

std::string_view name_of(Medium medium) {
    switch (medium) {
    case Medium::none: return "none";
    case Medium::air: return "air";
    case Medium::material: return "material";
    }
    return "?";
}

std::string_view name_of(AirFormula formula) {
    return formula == AirFormula::ciddor ? "ciddor" : "edlen";
}
std::string_view name_of(ExpansionForm form) {
    return form == ExpansionForm::first_order ? "first_order" : "exact";
}

std::string_view name_of(EveModel model) {
    return model == EveModel::difference ? "difference" : "mean";
}

std::string_view stored_unit_of(ChannelKind kind) {
    switch (kind) {
    case ChannelKind::displacement: return "m";
    case ChannelKind::temperature: return "degC";
    case ChannelKind::pressure: return "Pa";
    case ChannelKind::humidity: return "%";
    case ChannelKind::carbon_dioxide: return "ppm";
    case ChannelKind::strength: return "%";
    case ChannelKind::angle: return "arcsec";
    }
    return "?";
}

std::string_view name_of(EventKind kind) {
    switch (kind) {
    case EventKind::opened: return "opened";
    case EventKind::armed: return "armed";
    case EventKind::datum: return "datum";
    case EventKind::refused: return "refused";
    case EventKind::skipped: return "skipped";
    case EventKind::interrupted: return "interrupted";
    case EventKind::resumed: return "resumed";
    case EventKind::aborted: return "aborted";
    case EventKind::closed: return "closed";
    case EventKind::note: return "note";
    case EventKind::instrument: return "instrument";
    }
    return "?";
}

std::string_view reference_word_of(const RunRecord& run) {
    return run.scale ? "scale" : "laser";
}

bool sits_on_scale(const RunRecord& run, int channel) {
    return run.scale &&
           std::ranges::find(run.scale->channels, channel) != run.scale->channels.end();
}

Result<void> check_complete(const RunRecord& run) {
    if (run.points.size() > run.plan.points.size())
        return fail(Fault::bad_run_file, "the run has more points than its plan");
    for (std::size_t i = 0; i < run.plan.points.size(); ++i) {
        const bool present = i < run.points.size() && run.points[i].planned == run.plan.points[i];
        if (!present)
            return fail(Fault::incomplete_run, "step " + std::to_string(i + 1) + " of " +
                                                   std::to_string(run.plan.points.size()) +
                                                   " has no point");
        if (run.points[i].datum_id != run.points.front().datum_id)
            return fail(Fault::datum_lost, "step " + std::to_string(i + 1) +
                                               " was captured under another datum than step 1");
    }
    return {};
}

} // namespace axiscal
