// The table of the station file that only one kind of test has.
#include "config/section_readers.hpp"
#include "tests/unit/config/station_text.hpp"

namespace axiscal::kind_section_test {
namespace {

TEST(KindSection, AKindWithoutATableOfItsOwnHasReadNothing) {
    const auto reading = test::read_text(test::example_text());
    EXPECT_EQ(config_of<int>(TestKind::probing, reading.config), nullptr);
}

TEST(KindSection, WhatItsReaderSaidIsFoundByKind) {
    auto document = test::document_of("[part]\nsize = 3\n");
    StationConfig config;
    Settings table = document.root().table("part");
    const int size = static_cast<int>(table.integer("size", 1, 9));
    config.kind_sections.push_back(KindSection{TestKind::drift, table, size});
    const int* const found = config_of<int>(TestKind::drift, config);
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(*found, 3);
    EXPECT_EQ(config_of<int>(TestKind::circular, config), nullptr);
    EXPECT_EQ(test::told(document), "");
}

TEST(KindSection, OneThatNobodyReadIsRefusedKeyByKey) {
    auto document = test::document_of("[part]\nsize = 3\n");
    StationConfig config;
    config.kind_sections.push_back(KindSection{TestKind::drift, document.root().table("part"), {}});
    EXPECT_EQ(config_of<int>(TestKind::drift, config), nullptr);
    EXPECT_NE(test::told(document).find("part.size"), std::string::npos);
}

} // namespace
} // namespace axiscal::kind_section_test
