#include "analysis/quantity/time.hpp"

#include <cstdio>

namespace axiscal {

std::string iso8601_utc(std::int64_t utc_ns) {
    using namespace std::chrono;
    const sys_time<nanoseconds> instant{nanoseconds{utc_ns}};
    const auto day = floor<days>(instant);
    const year_month_day date{day};
    const hh_mm_ss clock{floor<seconds>(instant - day)};
    char text[32];
    std::snprintf(text, sizeof text, "%04d-%02u-%02uT%02d:%02d:%02dZ",
                  static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                  static_cast<unsigned>(date.day()), static_cast<int>(clock.hours().count()),
                  static_cast<int>(clock.minutes().count()),
                  static_cast<int>(clock.seconds().count()));
    return text;
}

} // namespace axiscal
