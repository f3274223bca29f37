#include "analysis/record/certificate_expiry.hpp"

namespace axiscal {

std::string run_date_of(const RunRecord& run) {
    constexpr std::size_t date_letters = 10;
    return iso8601_utc(run.opened.utc_ns).substr(0, date_letters);
}

bool has_expired(const std::string& due_on, const std::string& date) {
    return !due_on.empty() && due_on < date;
}

std::string one_year_after(std::int64_t utc_ns) {
    using namespace std::chrono;
    const sys_time<nanoseconds> instant{nanoseconds{utc_ns}};
    const year_month_day day{floor<days>(instant)};
    year_month_day next = day + years{1};
    if (!next.ok()) next = next.year() / next.month() / last;
    const auto ns = duration_cast<nanoseconds>(sys_days{next}.time_since_epoch()).count();
    return iso8601_utc(ns).substr(0, 10);
}

std::string next_due_of(const Statements& stated, std::int64_t closed_utc_ns) {
    if (stated.next_due == "none") return "";
    return stated.next_due.empty() ? one_year_after(closed_utc_ns) : stated.next_due;
}

} // namespace axiscal
