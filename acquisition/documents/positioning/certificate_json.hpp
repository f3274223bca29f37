#pragma once
// certificate.json: the result document with where it came from. Pure.

#include "analysis/positioning/positioning_certificate.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace axiscal {

/// The document of result_to_json() with
/// - "compensation" replaced by an object (formulas, coefficients, largest corrections; deviations
///   before and after in plan order, in `unit`),
/// - "completeness": "status" ("complete" | "partial"), readings "expected" and "used", and
///   "left_out", an object for each target and direction of which planned readings enter no figure,
/// - "setup_findings", where the readings show a wrong set-up (setup_findings_json.hpp),
/// - "environment": every channel with place, correction and first, last, least, greatest,
/// - "run": who, what, when; plan, laser, material, air, instruments, datums, deviations, events,
///   remarks, "synchronisation" (what the uncertain time of its samples adds to each capture, step
///   -1 the datum; null: not stated; in um, of an autocollimator in arcsec), software version,
///   SHA-256 of the run file and digest of the result,
/// - "expanded_uncertainty", "budget" and "target_uncertainty" of add_uncertainty_json(), for each
///   parameter whose every term is stated,
/// - "preliminary"; when true, "missing" says in words what is not stated, and
///   "expanded_uncertainty" names the parameters without U: "not evaluated".
/// `positions` and the values in `parameters` are those of the result, unchanged.
/// What a person left empty is null. Lengths are in mm unless the key says otherwise. Every double
/// survives dump() and parse() exactly.
nlohmann::ordered_json certificate_to_json(const Certificate& certificate);

} // namespace axiscal
