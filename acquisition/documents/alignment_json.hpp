#pragma once
// How the beam was aligned, as a certificate says it. Pure.

#include "analysis/quantity/time.hpp"
#include "analysis/record/alignment_record.hpp"

#include <nlohmann/json.hpp>

#include <optional>

namespace axiscal {

/// null where no alignment was recorded.
nlohmann::ordered_json alignment_to_json(const std::optional<AlignmentRecord>& alignment);

} // namespace axiscal
