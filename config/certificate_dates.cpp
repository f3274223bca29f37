#include "config/certificate_dates.hpp"

namespace axiscal {
namespace {

Refusal
expired(const StationConfig& config, int line, const std::string& what, const std::string& due_on) {
    return {config.file, line, "due_on",
            "the certificate of " + what + " was due on " + due_on +
                ": have it calibrated, or correct the date; runs made now say \"expired\""};
}

} // namespace

std::vector<Refusal> expired_certificates(const StationConfig& config, const std::string& today) {
    std::vector<Refusal> notes;
    if (config.axis.angle) {
        const InstrumentRecord& artefact = config.axis.angle->artefact;
        if (!artefact.due_on.empty() && artefact.due_on < today)
            notes.push_back(expired(config, 0, "the " + artefact.name, artefact.due_on));
    }
    for (const InstrumentConfig& instrument : config.instruments) {
        if (!instrument.due_on.empty() && instrument.due_on < today)
            notes.push_back(
                expired(config, instrument.line, "\"" + instrument.name + "\"", instrument.due_on));
        for (const ChannelConfig& channel : instrument.channels) {
            const std::string& due_on = channel.calibration.due_on;
            if (due_on.empty() || due_on >= today) continue;
            notes.push_back(expired(config, channel.line,
                                    "\"" + instrument.name + "/" + channel.channel + "\"", due_on));
        }
    }
    return notes;
}

} // namespace axiscal
