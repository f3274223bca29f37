#pragma once
// Whether an instrument's certificate was good when a run was made, and when the run's own is due.
// Pure.

#include "analysis/record/run_record.hpp"

#include <cstdint>
#include <string>

namespace axiscal {

/// ISO date (UTC) on which the run was opened.
std::string run_date_of(const RunRecord& run);

/// A certificate due on `due_on` was no longer good on `date`; the day itself is. Both are ISO
/// dates; false when no due date is stated.
bool has_expired(const std::string& due_on, const std::string& date);

/// ISO date of the same day next year; 28 February stands for 29 February.
std::string one_year_after(std::int64_t utc_ns);

/// The date until which the run's certificate is recommended to hold; empty where none is. ISO/IEC
/// 17025:2017, 7.8.4.3 allows such a recommendation only where it was agreed with the customer.
std::string next_due_of(const Statements& stated, std::int64_t closed_utc_ns);

} // namespace axiscal
