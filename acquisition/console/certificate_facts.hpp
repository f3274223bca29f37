#pragma once
// What a list of runs says of a certificate, out of certificate.json as it lies on a disk: what is
// there may be damaged, or may not be ours. Nothing is computed. Pure.

#include "analysis/quantity/result.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// A figure of the certificate, in its unit, as it stands there.
struct CertifiedFigure {
    std::string parameter;
    std::optional<double> value, expanded_uncertainty, limit;
    std::string verdict; ///< pass | fail | not_provable | not_evaluated; empty: no limit
    std::string reason;  ///< the certificate's own words; empty: none
};

struct CertificateFacts {
    std::string run_id, started_utc, result_digest; ///< as its "run" says
    std::string number;                             ///< empty: none
    std::string standard, unit;                     ///< unit: mm, um, deg, arcsec, um/m
    std::string verdict;      ///< over all limits; empty: none were agreed on, or it is partial
    std::string limits, rule; ///< name of the set that was agreed on
    std::vector<CertifiedFigure> figures; ///< those with a limit first; at most 40
    std::size_t left_out = 0;             ///< readings that a person left out
    bool partial = false;                 ///< no certificate: no verdict is read of it
};

/// Each text becomes one line of at most 300 bytes; what has another type than ours counts as not
/// there. @errors Fault::bad_case for what is no JSON object, or names no run.
Result<CertificateFacts> facts_of_certificate(std::string_view text);

} // namespace axiscal
