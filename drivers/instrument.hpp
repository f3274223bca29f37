#pragma once
// The face every instrument shows: it hands up samples and knows nothing of cycles. Loop-bound.

#include "config/instrument_config.hpp"
#include "drivers/sample.hpp"
#include "drivers/wire/byte_link.hpp"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

struct Identity {
    std::string maker, model, serial, firmware;
};

class SampleSink {
public:
    virtual ~SampleSink() = default;
    virtual void take(const Sample& sample) = 0;
    /// What the instrument says of itself; may come again when more is known.
    virtual void identify(const Identity& identity) = 0;
    /// Something a person should know ("beam lost", "counter restarted: datum lost"). Repeats are
    /// counted above.
    virtual void note(Fault fault, std::string sentence) = 0;
};

struct InstrumentContext {
    Scheduler* scheduler = nullptr;
    LinkOpener* links = nullptr;
    SampleSink* sink = nullptr;
};

/// Counted, never silent: frames dropped for each reason, gaps in the device's own numbering.
struct InstrumentCounters {
    std::uint64_t frames = 0, samples = 0, bad_frames = 0, checksum_errors = 0, gaps = 0,
                  lost_records = 0, restarts = 0, timeouts = 0;
};

class Instrument {
public:
    virtual ~Instrument() = default;
    [[nodiscard]] virtual const std::vector<Channel>& channels() const = 0;
    /// Opens the link, reads for ever, returns only with the error that ended it. May be called
    /// again after an error; the epoch of an incremental counter then goes on rising.
    virtual Task<Result<void>> run(InstrumentContext context) = 0;
    [[nodiscard]] virtual const InstrumentCounters& counters() const = 0;
    /// Optical constants of an interferometer; empty for other instruments.
    struct Optics {
        Length vacuum_wavelength;
        double optical_fold = 2;
    };
    [[nodiscard]] virtual std::optional<Optics> optics() const { return std::nullopt; }
    /// Length of one count of a linear scale; empty for a laser, and for what is no incremental
    /// scale.
    [[nodiscard]] virtual std::optional<Length> resolution() const { return std::nullopt; }
    /// Where the device's own sample number begins again (65536 for 16 bits); 0: it does not.
    [[nodiscard]] virtual std::uint64_t count_modulus() const { return 0; }
    /// Counts from where it was: its zero holds only while it counts on. Every interferometer does,
    /// a scale behind a counter, too.
    [[nodiscard]] virtual bool incremental() const { return optics().has_value(); }
};

struct Appearance;

/// One row of the registry: how a driver is called in the station file and made from it.
/// `make` opens nothing; it reads the driver's own keys from `options` and refuses through it.
struct InstrumentDriver {
    std::string_view name;    ///< "umd", "dracal-vcp", "modbus"
    std::string_view summary; ///< one line for `axiscal devices --drivers`
    std::unique_ptr<Instrument> (*make)(const InstrumentConfig& config,
                                        Settings& options) = nullptr;
    const Appearance* shows = nullptr; ///< how it is found when plugged in; null: it is not
    /// Why no tape can stand in for its link, with the way out; empty: one can.
    std::string_view no_tape = {};
};

} // namespace axiscal
