#pragma once
// The numbers that certificates bear: made by a pattern, each given once, kept in the state
// directory over every restart. Blocking.

#include "analysis/quantity/result.hpp"

#include <string>
#include <string_view>

namespace axiscal {

/// Beside the run files: one line a number, `count TAB closing TAB run id TAB number`.
inline constexpr std::string_view certificate_numbers_file = "certificate-numbers";

/// What [certificate] number of a station file says: a pattern where it holds a brace, else one
/// number for one certificate. Its tokens are {year}, {count} and, with at least so many digits,
/// {count:1} to {count:9}. Empty: certificates bear no number.
bool is_number_pattern(std::string_view text);

struct NumberWanted {
    std::string pattern;
    std::string run_id;
    int closing = 1; ///< of the run, from 1
    int year = 0;    ///< in which the certificate is issued
};

/// The number of that paper: the one that it was given earlier, else a new one, which is on disk
/// when this returns. A number that another paper bears is passed over: a pattern takes the next
/// count, a plain number gets -2, -3 ... behind it. Counts never begin anew; one that was taken for
/// a paper that was never finished is a gap. Processes that ask at once wait for each other.
/// @errors Fault::io; Fault::refused for a file of numbers that cannot be read.
Result<std::string> take_certificate_number(const std::string& state_directory,
                                            const NumberWanted& wanted);

/// Before a run is armed: a plain number that another run bears is refused.
/// @errors Fault::refused with the way out, and as above.
Result<void> check_number_is_free(const std::string& state_directory, const std::string& number);

} // namespace axiscal
