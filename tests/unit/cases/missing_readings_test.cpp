// `null` in the rows of a positioning case is a reading that is missing.
#include "tests/unit/cases/asked.hpp"

namespace axiscal::missing_readings_test {
namespace {

using nlohmann::json;
using test::answer_to, test::refused_field, test::with;

/// Three approaches; the reading that is missing below is the mean of the other two, so that each
/// mean stays and s is that of two readings.
json whole() {
    return json::parse(R"({"analysis":"positioning","standard":"ISO 230-2:2014",
        "axis":{"name":"X","kind":"linear"},"unit":"um","target_unit":"mm","readings":"deviations",
        "targets":[0,500,1000],"forward":[[0,1,2],[3,5,4],[6,7,8]],
        "backward":[[-2,-1,0],[1,2,3],[4,5,6]]})");
}

TEST(MissingReadings, LeaveEachTargetTheReadingsThatItHas) {
    const json all = answer_to(whole());
    EXPECT_FALSE(all.contains("completeness"));
    const json gap = answer_to(with(whole(), "/forward/1/2", nullptr));
    EXPECT_EQ(gap["completeness"],
              json::parse(
                  R"({"status":"partial","expected":18,"used":17,"left_out":["forward[1][2]"]})"));
    for (const char* figure : {"M", "E", "E_forward", "B", "B_mean"}) // of means alone
        EXPECT_DOUBLE_EQ(gap["parameters"][figure]["value"].get<double>(),
                         all["parameters"][figure]["value"].get<double>())
            << figure;
    // s of 3 and 5: sqrt(2); R_forward = 4 s there, where s is 1 of all others.
    EXPECT_DOUBLE_EQ(gap["parameters"]["R_forward"]["value"].get<double>(), 4 * std::sqrt(2.0));
    EXPECT_DOUBLE_EQ(all["parameters"]["R_forward"]["value"].get<double>(), 4.0);
}

TEST(MissingReadings, TakeTheFiguresAwayThatNeedThem) {
    json request = whole();
    request["forward"][0] = {0, nullptr, nullptr};
    const json gap = answer_to(request);
    for (const char* figure : {"A", "A_forward", "R", "R_forward"})
        EXPECT_FALSE(gap["parameters"].contains(figure)) << figure;
    EXPECT_TRUE(gap["parameters"].contains("E"));
    request["forward"][0] = {nullptr, nullptr, nullptr};
    EXPECT_EQ(refused_field(request), "forward[0]");
}

TEST(MissingReadings, MakeNoVerdictAndTheUncertaintyOfTheFewest) {
    json request = with(whole(), "/forward/1/2", nullptr);
    request["tolerances"] = {{"A", 100}};
    request["uncertainty"] = {{"device_width_um", 1}, {"eve_um", 3}};
    const json gap = answer_to(request);
    EXPECT_FALSE(gap.dump().find("verdict\":") != std::string::npos);
    // 2 x 2 u_EVE / sqrt(n - 1) x k with n = 2 and u_EVE = 3 / sqrt 12 (ISO 230-2, annex A).
    EXPECT_NEAR(gap["parameters"]["R_forward"]["expanded_uncertainty"]["value"].get<double>(),
                4 * std::sqrt(3.0), 1e-12);
}

TEST(MissingReadings, AreStatedAndNotLeftOut) {
    json request = whole();
    request["forward"][1] = {3, 5};
    EXPECT_EQ(refused_field(request), "forward[1]");
    json other = with(whole(), "/forward/1/2", nullptr);
    other["standard"] = "VDI/DGQ 3441";
    EXPECT_EQ(refused_field(other), "forward[1][2]");
}

} // namespace
} // namespace axiscal::missing_readings_test
