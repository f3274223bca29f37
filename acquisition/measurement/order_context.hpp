#pragma once
// What a test that a person orders is opened with.

#include "acquisition/measurement/positioning/positioning_port.hpp"

#include <string>

namespace axiscal {

class BeamWatch;
class DiskWait;
class LatestTests;
class Recovery;

/// What somebody does just now and nobody else may begin beside it.
struct UnderWay {
    bool arming = false;   ///< a test is being opened
    bool revising = false; ///< a retake, an exclusion or an answer is being kept
};

/// As PositioningContext, of a test of any kind that is not open yet.
struct OrderContext : PositioningContext {
    LatestTests& tests;
    Recovery& recovery;
    const DiskWait& disk;
    BeamWatch& beam;
    UnderWay& under_way;
    const std::string& may_sleep; ///< why the computer may fall asleep; empty: it may not
};

} // namespace axiscal
