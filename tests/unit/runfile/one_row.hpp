#pragma once
// Rows written one by one, and what a folder has open: the product writes batches.

#include "acquisition/runfile/run_file.hpp"

#include <span>
#include <utility>

namespace axiscal::testing {

inline Result<void> append(RunFileWriter& writer, PointRecord point) {
    RunBatch batch;
    batch.point = std::move(point);
    return writer.write(batch);
}

inline Result<void> append(RunFileWriter& writer, DatumRecord datum) {
    RunBatch batch;
    batch.datum = std::move(datum);
    return writer.write(batch);
}

inline Result<void> append(RunFileWriter& writer, std::span<const EnvironmentReading> readings) {
    RunBatch batch;
    batch.environment.assign(readings.begin(), readings.end());
    return writer.write(batch);
}

inline std::vector<std::string> open_run_files(const std::string& folder) {
    std::vector<std::string> paths;
    for (const auto& summary : list_run_files(folder))
        if (!summary.closed) paths.push_back(summary.path);
    return paths;
}

} // namespace axiscal::testing
