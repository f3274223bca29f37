#pragma once
// The instruments' and channels' part of metrics_text(). Private to the console.

#include "acquisition/live/station_interface.hpp"

#include <vector>

namespace axiscal {

class MetricsWriter;

void write_metrics_of(const std::vector<InstrumentView>& instruments, MetricsWriter& to);
void write_metrics_of(const std::vector<ChannelView>& channels, MetricsWriter& to);

} // namespace axiscal
