#include "analysis/certificate_expiry.hpp"

namespace axiscal {

std::string run_date_of(const RunRecord& run) {
    constexpr std::size_t date_letters = 10;
    return iso8601_utc(run.opened.utc_ns).substr(0, date_letters);
}

bool has_expired(const std::string& due_on, const std::string& date) {
    return !due_on.empty() && due_on < date;
}

} // namespace axiscal
