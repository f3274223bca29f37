#pragma once
// What a tape says about itself beside its transfers. Pure.

#include "config/settings.hpp"
#include "drivers/instrument.hpp"
#include "drivers/recording/tape_link.hpp"

#include <string>
#include <utility>
#include <vector>

namespace axiscal {

using HeaderLines = std::vector<std::pair<std::string, std::string>>;

/// The driver's own lines of [[instrument]] `name` in a station file, "key = value" each: what the
/// station states about it (names, certificate, channels) is left out.
HeaderLines driver_keys(const std::string& station_text, const std::string& name);

/// "key = value" a line; what would break a line is a blank.
std::string header_text(const HeaderLines& lines);

/// The instrument of a tape that tells driver and keys ("driver = umd", "key.fold = ...").
/// @errors Fault::bad_request when it does not, naming what is missing or refused.
Result<std::unique_ptr<Instrument>> instrument_of(const Tape& tape);

/// The [[instrument]] block of a station file with which axiscald plays the tape at `full_path` to
/// its driver. @errors as instrument_of; Fault::bad_request where no tape can stand in, too.
Result<std::string>
block_text(const Tape& tape, const std::string& name, const std::string& full_path);

} // namespace axiscal
