// What is asked of the instruments: that they speak, their signal, their certificates.
#include "acquisition/preflight/preflight_checks.hpp"

#include "acquisition/capture/wording.hpp"

#include "analysis/setup/frozen_sensor.hpp"

#include <algorithm>
#include <cctype>

namespace axiscal::preflight_checks {
namespace {

/// "air" of "air/temperature".
std::string instrument_of(const SensorFacts& sensor) {
    return sensor.name.substr(0, sensor.name.find('/'));
}

/// What each instrument of the air showed within the last `window`.
std::vector<AirInstrument> air_instruments_of(const PreflightFacts& facts, Duration window) {
    std::vector<AirInstrument> instruments;
    for (const SensorFacts& sensor : facts.sensors) {
        if (sensor.medium != Medium::air) continue;
        const std::string name = instrument_of(sensor);
        auto found = std::ranges::find(instruments, name, &AirInstrument::name);
        if (found == instruments.end())
            found = instruments.insert(instruments.end(), AirInstrument{name, {}});
        found->tracks.push_back({sensor.kind, sensor.log->last(window, facts.now), sensor.as_sent});
    }
    return instruments;
}

/// Air sensors that answer and repeat their last reading.
void join_frozen(std::string& wrong, const PreflightFacts& facts) {
    for (const AirInstrument& instrument :
         air_instruments_of(facts, facts.config.preflight.soak_window)) {
        const auto span = find_frozen_span(instrument.tracks);
        if (!span) continue;
        const Duration lasted = from_seconds(span->end_s - span->begin_s);
        join(wrong, instrument.name + " repeats its last reading: no figure changed for " +
                        in_minutes(lasted) + ", unplug it and plug it in again");
    }
}

/// Letters and digits alone, without leading noughts: "00-42a" is "42A" to a person.
std::string plain_serial(const std::string& serial) {
    std::string plain;
    for (const char c : serial) {
        const auto letter = static_cast<unsigned char>(c);
        if (std::isalnum(letter) == 0 || (plain.empty() && c == '0')) continue;
        plain += static_cast<char>(std::toupper(letter));
    }
    return plain;
}

/// The certificate in the station file is that of another instrument than the one that is there.
void join_exchanged(std::string& wrong,
                    const InstrumentConfig& instrument,
                    const PreflightFacts& facts) {
    const auto told = facts.serials.find(instrument.name);
    if (told == facts.serials.end() || instrument.serial.empty()) return;
    if (plain_serial(told->second) == plain_serial(instrument.serial)) return;
    join(wrong, instrument.name + " has the serial number " + told->second +
                    ", and the station file states serial = \"" + instrument.serial +
                    "\" with its certificate");
}

} // namespace

PreflightRecord check_instruments(const PreflightFacts& facts) {
    constexpr Duration length_limit = std::chrono::seconds{2};
    std::string wrong;
    for (const std::string& name : facts.unavailable)
        join(wrong, name + " is not available");
    for (const InstrumentConfig& instrument : facts.config.instruments)
        if (!instrument.tape.empty())
            join(wrong,
                 instrument.name + " plays a tape and is no instrument (no reason overrides this)");
    for (const SensorFacts& sensor : facts.sensors)
        if (!sensor.fresh)
            join(wrong, sensor.name + " gives no fresh reading (" + sensor.quality + ")");
    join_frozen(wrong, facts);
    // At rest a ballbar may be out of its range: that it speaks is enough.
    const auto& age = facts.circular ? facts.bar_age : facts.laser_age;
    if (!facts.polygon && (!age || *age > length_limit))
        join(wrong, "the " + length_word_of(facts) + " gives no fresh reading");
    if (facts.faces_read && (!facts.face_age || *facts.face_age > length_limit))
        join(wrong, "the autocollimator does not answer");
    if (wrong.empty())
        return passed("instruments", "Every instrument is available and its readings are fresh.");
    return failed("instruments",
                  wrong + ". Check the cables; 'axiscal devices' shows what is connected.");
}

PreflightRecord check_strength(const PreflightFacts& facts) {
    const double limit = facts.config.preflight.least_strength_percent;
    std::optional<double> lowest;
    for (const SensorFacts& strength : facts.strengths)
        if (const auto found = strength.log->lowest())
            lowest = std::min(lowest.value_or(*found), *found);
    if (facts.polygon)
        return passed("strength",
                      facts.faces_read
                          ? "The autocollimator does not report the strength of its light."
                          : "A person reads the autocollimator.");
    if (!lowest)
        return passed("strength", "The " + length_word_of(facts) +
                                      " does not report the strength of its signal.");
    const std::string seen = "The weakest recent signal was " + plain_number(*lowest, 0) + " %";
    if (*lowest >= limit) return passed("strength", seen + ".");
    return failed("strength", seen + "; at least " + plain_number(limit, 0) +
                                  " % is required. Align the beam over the whole travel.");
}

/// A date that is past blocks, and so does the certificate of another instrument. What is not
/// stated does not, for a shop may have no certificates: it is named, and the certificate says so.
PreflightRecord check_certificates(const PreflightFacts& facts) {
    std::string expired, silent;
    for (const InstrumentConfig& instrument : facts.config.instruments) {
        if (std::ranges::find(facts.in_use, instrument.name) == facts.in_use.end()) continue;
        join_exchanged(expired, instrument, facts);
        for (const ChannelConfig& channel : instrument.channels)
            if (!channel.calibration.due_on.empty() && channel.calibration.due_on < facts.today)
                join(expired, instrument.name + "/" + channel.channel +
                                  " was due for calibration on " + channel.calibration.due_on);
        if (!instrument.due_on.empty() && instrument.due_on < facts.today)
            join(expired, instrument.name + " was due for calibration on " + instrument.due_on);
        else if (instrument.certificate_number.empty())
            join(silent, instrument.name + " has no certificate_number in the station file");
        else if (instrument.due_on.empty())
            join(silent, instrument.name + " has no due_on in the station file");
    }
    if (facts.config.axis.angle && !facts.circular) {
        const InstrumentRecord& artefact = facts.config.axis.angle->artefact;
        if (!artefact.due_on.empty() && artefact.due_on < facts.today)
            join(expired, artefact.name + " was due for calibration on " + artefact.due_on);
        else if (artefact.certificate_number.empty())
            join(silent, artefact.name + " has no certificate_number in the station file");
    }
    const std::string unknown =
        silent.empty() ? "" : silent + ". Whether it is calibrated and in date is not known.";
    if (!expired.empty())
        return failed("certificates", expired +
                                          ". Have it calibrated, or enter the new certificate." +
                                          (unknown.empty() ? "" : " Besides: " + unknown));
    if (!unknown.empty()) return warned("certificates", unknown);
    return passed("certificates", "Every instrument has a certificate that is in date.");
}

} // namespace axiscal::preflight_checks
