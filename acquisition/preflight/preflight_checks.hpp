#pragma once
// The checks of judge_preflight one by one, and the words that they share. Internal to
// preflight*.cpp. Pure.

#include "acquisition/preflight/preflight.hpp"

#include <string>
#include <utility>

namespace axiscal::preflight_checks {

inline constexpr double nearly_whole = 0.95; // of a window: the first reading came a little late

inline PreflightRecord passed(std::string name, std::string verdict) {
    return {std::move(name), true, false, std::move(verdict), {}};
}
inline PreflightRecord warned(std::string name, std::string verdict) {
    return {std::move(name), true, true, std::move(verdict), {}};
}
inline PreflightRecord failed(std::string name, std::string verdict) {
    return {std::move(name), false, false, std::move(verdict), {}};
}

/// In seconds where there are less than two minutes.
std::string in_minutes(Duration span);
/// Another sentence part, behind a semicolon.
void join(std::string& list, const std::string& item);
/// "laser" | "scale" | "ballbar": what the length comes from.
std::string length_word_of(const PreflightFacts& facts);
/// Slope of the straight line through a whole series, in its units a second.
double slope_of(const DriftSeries& series);

// preflight_instruments.cpp
PreflightRecord check_instruments(const PreflightFacts& facts);
PreflightRecord check_strength(const PreflightFacts& facts);
PreflightRecord check_certificates(const PreflightFacts& facts);

// preflight_temperature.cpp
PreflightRecord check_soak(const PreflightFacts& facts);
PreflightRecord check_sensors(const PreflightFacts& facts);
PreflightRecord check_contact(const PreflightFacts& facts);
PreflightRecord check_environment(const PreflightFacts& facts);

// preflight_drift.cpp
PreflightRecord check_drift(const PreflightFacts& facts);

// preflight_eve.cpp
PreflightRecord check_eve(const EveFacts& eve);

// preflight_statements.cpp
PreflightRecord check_expansion(const PreflightFacts& facts);
PreflightRecord check_compensation(const PreflightFacts& facts);
PreflightRecord check_run_out(const PreflightFacts& facts);
/// Of an axis that a beam measures.
bool states_no_dead_path(const PreflightFacts& facts);
PreflightRecord doubt_dead_path();

// preflight_computer.cpp
PreflightRecord check_computer(const PreflightFacts& facts);
PreflightRecord check_clock(const PreflightFacts& facts);

} // namespace axiscal::preflight_checks
