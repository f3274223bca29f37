// A live run by the standards that its station file chose.

#include "analysis/positioning/chosen_standards.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace axiscal::chosen_standards_test {
namespace {

TEST(ChosenStandards, WithoutAChoiceItIsTheNewestEdition) {
    const auto chosen = chosen_standards({});
    ASSERT_TRUE(chosen);
    EXPECT_EQ(chosen->own->name, "ISO 230-2:2014");
    EXPECT_TRUE(chosen->others.empty());
}

TEST(ChosenStandards, TheFirstEditionOfIso230IsTheCertificatesOwn) {
    const auto chosen = chosen_standards({"VDI/DGQ 3441", "GB/T 17421.2-2016", "ISO 230-2:1988"});
    ASSERT_TRUE(chosen);
    EXPECT_EQ(chosen->own->name, "GB/T 17421.2-2016");
    ASSERT_EQ(chosen->others.size(), 2U);
    EXPECT_EQ(chosen->others[0]->name, "VDI/DGQ 3441");
    EXPECT_EQ(chosen->others[1]->cover_factor, 3);
}

TEST(ChosenStandards, AnUnknownOneIsRefusedWithTheNamesThatAreKnown) {
    const auto chosen = chosen_standards({"ISO 230-2:2099"});
    ASSERT_FALSE(chosen);
    EXPECT_NE(chosen.error().detail.find("\"ISO 230-2:2099\" is not known"), std::string::npos);
    EXPECT_NE(chosen.error().detail.find("\"VDI/DGQ 3441\""), std::string::npos);
}

double value_of(const OtherResult& result, std::string_view name) {
    const auto found = std::ranges::find(result.parameters, name, &NamedFigure::name);
    return found == result.parameters.end() ? -1 : found->value;
}

// Two approaches each way, in um. Forward means 2 and 4, backward 0 and 2; s = sqrt(2) everywhere.
RunAt20C by_hand() {
    return declare_at_20C({{0, 100}, {{1, 3}, {3, 5}}, {{-1, 1}, {1, 3}}, "um"}, "made by hand")
        .value();
}

TEST(EvaluateOther, ThreeStandardDeviationsOfTheOldEdition) {
    const OtherResult old = evaluate_other(*find_positioning_standard("ISO 230-2:1988"), by_hand());
    EXPECT_NEAR(value_of(old, "R_forward"), 6 * std::sqrt(2.0), 1e-12); // 6 s
    EXPECT_NEAR(value_of(old, "A"), 4 + 6 * std::sqrt(2.0), 1e-12);     // 4 + 3 s - (0 - 3 s)
    EXPECT_NEAR(value_of(old, "E"), 4, 1e-12);
}

TEST(EvaluateOther, OfVdi3441TheFormulasOfItsOwn) {
    const OtherResult vdi = evaluate_other(*find_positioning_standard("VDI/DGQ 3441"), by_hand());
    EXPECT_NEAR(value_of(vdi, "Pa"), 2, 1e-12);                      // means 1 and 3
    EXPECT_NEAR(value_of(vdi, "U_max"), 2, 1e-12);                   // |B_i|
    EXPECT_NEAR(value_of(vdi, "Ps_max"), 6 * std::sqrt(2.0), 1e-12); // 6 s
    EXPECT_NEAR(value_of(vdi, "P"), 2 + 2 + 6 * std::sqrt(2.0), 1e-12);
    EXPECT_EQ(vdi.confidence, "certain");
}

} // namespace
} // namespace axiscal::chosen_standards_test
