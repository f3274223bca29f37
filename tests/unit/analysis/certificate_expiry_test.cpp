#include "analysis/record/certificate_expiry.hpp"

#include <gtest/gtest.h>

namespace axiscal::certificate_expiry_test {
namespace {

TEST(CertificateExpiry, IsTheDayAfterTheDueDate) {
    EXPECT_FALSE(has_expired("2026-11-21", "2026-11-21"));
    EXPECT_TRUE(has_expired("2026-11-21", "2026-11-22"));
    EXPECT_TRUE(has_expired("2025-12-31", "2026-01-01"));
    EXPECT_FALSE(has_expired("", "2026-11-22"));
}

TEST(CertificateExpiry, CountsTheDayOnWhichTheRunWasOpened) {
    RunRecord run;
    run.opened.utc_ns = 1'795'255'200'000'000'000; // 2026-11-21T10:00:00Z
    EXPECT_EQ(run_date_of(run), "2026-11-21");
}

} // namespace
} // namespace axiscal::certificate_expiry_test
