#pragma once
// Reads tests/reference and makes tables from it.

#include "analysis/positioning/positioning_accuracy.hpp"
#include "tests/support/source_dir.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace axiscal::test {

using Rows = std::vector<std::vector<double>>;

inline std::string reference_path(const std::string& name) {
    return source_dir() + "/tests/reference/" + name;
}

inline nlohmann::json reference_json(const std::string& name) {
    std::ifstream file{reference_path(name)};
    return nlohmann::json::parse(file);
}

/// Deviations of printed positions.
inline Rows minus_targets(Rows positions, const std::vector<double>& targets) {
    for (std::size_t i = 0; i < positions.size(); ++i)
        for (double& value : positions[i])
            value -= targets[i];
    return positions;
}

inline RunAt20C at_20C(std::vector<double> targets, Rows forward, Rows backward) {
    DeviationTable table{std::move(targets), std::move(forward), std::move(backward), "mm"};
    return declare_at_20C(std::move(table), "test data").value();
}

} // namespace axiscal::test
