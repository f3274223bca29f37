#pragma once
// certificate.json of a circular test: the result document with where it came from. Pure.

#include "analysis/circular/circular_certificate.hpp"

#include <nlohmann/json.hpp>
#include <string>

namespace axiscal {

/// The document of circular_to_json() with
/// - "expanded_uncertainty" at those figures alone whose every term is stated; "preliminary", and
///   when true "missing" in words and "expanded_uncertainty": "not evaluated" by figure,
/// - "zones": of each G the ring's centre and radii, what holds it, and the least squares circle,
/// - "repeats": each figure of each repeat,
/// - "compensation" replaced by an object: temperatures and coefficients of bar and machine,
/// - "run": who, what, when; what is driven, how it was read, each circle, instruments, events,
///   remarks, software version, SHA-256 of the run file (of the case) and digest of the figures,
/// - "environment": temperatures of air, bar and machine.
/// What nobody stated is null. The readings stand in certificate.csv.
nlohmann::ordered_json circular_certificate_to_json(const CircularCertificate& certificate);

} // namespace axiscal
