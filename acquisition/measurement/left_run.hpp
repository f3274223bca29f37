#pragma once
// A run that an earlier daemon left open, and what becomes of it.

#include "acquisition/measurement/measurement.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "analysis/quantity/result.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

namespace axiscal {

/// How the file is closed of one that cannot go on.
struct LeftClosing {
    enum class As : std::uint8_t {
        incomplete,
        again,   ///< it was reopened for points to be taken again: what was before is whole
        complete ///< all was done, only the closing row is missing
    };
    std::string reason;
    Fault fault = Fault::none;
    As as = As::incomplete;
};

struct LeftRun {
    std::string path;
    RunFileContents contents;
    bool whole = false; ///< reopened, and what was measured before still makes a whole run
    [[nodiscard]] LeftClosing closed_for(std::string reason, Fault fault) const {
        LeftClosing closing;
        closing.reason = std::move(reason);
        closing.fault = fault;
        if (whole) closing.as = LeftClosing::As::again;
        return closing;
    }
};

struct TakenOver {
    std::shared_ptr<Measurement> test; ///< goes on, its file is open; null: it is to be closed
    LeftClosing closing;
};

} // namespace axiscal
