#pragma once
// One [[instrument]] of the station file, without the keys that only its driver understands.

#include "analysis/record/run_record.hpp"

#include <string>
#include <vector>

namespace axiscal {

class Settings;

/// How one channel of the instrument is used here.
struct ChannelConfig {
    std::string channel;          ///< the driver's channel name
    std::string name;             ///< name on certificate and screens; empty: the driver's
    std::optional<Medium> medium; ///< air | material, as stated; checked against the use
    std::string place;            ///< "spindle nose", "table left"
    double correction = 0;        ///< added, in stored_unit_of(kind)
    /// Unit in which the correction counts ("degC", "Pa", "%", "ppm", "m"), to be compared with the
    /// driver's kind; empty when none is stated.
    std::string correction_unit;
    /// Of this channel alone; empty fields are the instrument's. `channel` is not used here.
    ChannelCalibration calibration;
    /// Units in which the table and U count, to be compared with the driver's kind; empty: none.
    std::string table_unit, uncertainty_unit;
    int line = 0; ///< in the station file, for messages
};

struct InstrumentConfig {
    std::string name;   ///< role here: "laser", "air", "material"
    std::string driver; ///< registry name
    std::string serial, certificate_number, calibrated_on, due_on;
    std::string tape; ///< full path of what is played in place of its link; empty: an instrument
    std::vector<ChannelConfig> channels;
    int line = 0; ///< in the station file, for messages
};

} // namespace axiscal
