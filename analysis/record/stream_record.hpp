#pragma once
// A channel recorded at its full rate, as it stands in a run file. Pure data.

#include "analysis/quantity/time.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace axiscal {

/// One recorded channel.
struct StreamSetup {
    int id = 0;      ///< 0-based within the run
    int channel = 0; ///< ChannelRecord::id
    std::string name, unit;
    double nominal_rate_hz = 0; ///< 0: not known
};

/// Consecutive samples without a hole, compressed.
struct StreamBlock {
    int stream = 0;
    std::int64_t index = 0;        ///< 0-based, of the blocks as they were made: one that is absent
                                   ///< was dropped because the disk did not keep up
    std::uint64_t first_count = 0; ///< the instrument's own number of the first sample; 0: none
    int samples = 0;
    std::uint64_t missing = 0; ///< samples that the instrument's numbering left out before it
    std::string before;        ///< "" goes on; "gap", "epoch", "beam_lost", "absent", ...
    MonotonicTime begin, end;  ///< of the first and the last sample
    double low = 0, high = 0;  ///< in the stream's unit
    std::string packed;        ///< acquisition/runfile/stream_packing.hpp
    Duration time_uncertainty{}; ///< u(t), the largest of its samples; 0: not stated for each
};

/// The same before it is compressed; `head.packed` is empty.
struct StreamChunk {
    StreamBlock head;
    std::vector<MonotonicTime> at;
    std::vector<double> value; ///< in the stream's unit
};

/// A hole before sample `at`.
struct StreamGap {
    std::size_t at = 0;
    std::uint64_t missing = 0; ///< 0: nobody numbers them, or the instrument had no good signal
    std::string why;
};

/// u(t) of the samples from number `from` on; 0: not stated.
struct StreamTime {
    std::size_t from = 0;
    Duration time_uncertainty{};
};

/// A stream as it was sampled: both lists are of one length, `at` ascends.
struct StreamSamples {
    std::vector<MonotonicTime> at;
    std::vector<double> value; ///< in the stream's unit
    std::vector<StreamGap> gaps;
    std::vector<StreamTime> times; ///< ascending; the first from 0
    std::uint64_t dropped_blocks = 0;
};

} // namespace axiscal
