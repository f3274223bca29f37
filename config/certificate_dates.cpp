#include "config/certificate_dates.hpp"

namespace axiscal {

std::vector<Refusal> expired_certificates(const StationConfig& config, const std::string& today) {
    std::vector<Refusal> notes;
    for (const InstrumentConfig& instrument : config.instruments) {
        if (instrument.due_on.empty() || instrument.due_on >= today) continue;
        notes.push_back({config.file, instrument.line, "due_on",
                         "the certificate of \"" + instrument.name + "\" was due on " +
                             instrument.due_on +
                             ": have it calibrated, or correct the date; runs made now say "
                             "\"expired\""});
    }
    return notes;
}

} // namespace axiscal
