#pragma once
// What the last pages of every certificate have: all instruments, channels, remarks, events.

#include "acquisition/documents/pdf/sheet.hpp"
#include "analysis/record/run_record.hpp"

#include <string>
#include <vector>

namespace axiscal {

void draw_instruments(Sheet& sheet,
                      const std::vector<InstrumentRecord>& instruments,
                      const std::string& run_date);

/// Certificates of single channels with their tables; nothing where none is stated.
void draw_calibrations(Sheet& sheet,
                       const std::vector<ChannelCalibration>& calibrations,
                       const std::vector<ChannelRecord>& channels,
                       const std::string& run_date);

/// @param shortened  what the front page could not print in full
void draw_remarks(Sheet& sheet,
                  const std::vector<std::string>& remarks,
                  const std::vector<StatedField>& shortened);

/// What went otherwise than planned; nothing when nothing did.
void draw_events(Sheet& sheet, const std::vector<EventRecord>& events, const ClockTie& opened);

} // namespace axiscal
