#include "tools/axiscal/conformance/kit.hpp"

#include "tests/support/scratch_folder.hpp"

#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>

namespace axiscal::kit_test {
namespace {

using testing::ScratchFolder;
using testing::write_bytes;

std::string case_text(const std::string& id) {
    return R"({"id":")" + id +
           R"(","title":"t","origin":"published","source":"s","case":{},"expect":[{"at":"/a","equals":1}]})";
}

class ConformanceKit : public ::testing::Test {
protected:
    void SetUp() override {
        for (const char* id : {"circle-1", "circle-2", "drift-1"})
            write_bytes(folder.file(std::string{id} + ".json"), case_text(id));
        write_bytes(folder.file("notes.txt"), "no case");
    }
    [[nodiscard]] std::vector<std::string> ids(const std::vector<std::string>& only) const {
        std::vector<std::string> found;
        const Kit kit = read_kit(folder.path(), only).value();
        for (const ConformanceCase& one : kit.cases)
            found.push_back(one.id);
        return found;
    }
    ScratchFolder folder;
};

TEST_F(ConformanceKit, IsReadInTheOrderOfIds) {
    EXPECT_EQ(ids({}), (std::vector<std::string>{"circle-1", "circle-2", "drift-1"}));
}

TEST_F(ConformanceKit, OnlyTakesIdsAndPatterns) {
    EXPECT_EQ(ids({"drift-1", "circle-2"}), (std::vector<std::string>{"circle-2", "drift-1"}));
    EXPECT_EQ(ids({"circle-*"}), (std::vector<std::string>{"circle-1", "circle-2"}));
    const auto wrong = read_kit(folder.path(), {"circel-1"});
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().fault, Fault::not_found);
    EXPECT_NE(wrong.error().detail.find("did you mean 'circle-1'"), std::string::npos);
}

TEST_F(ConformanceKit, NamesFileAndPlaceOfEveryMalformedCase) {
    write_bytes(folder.file("broken.json"), "{\n\"id\":");
    write_bytes(folder.file("drift-1.json"), case_text("drift-2"));
    const Kit kit = read_kit(folder.path(), {}).value();
    ASSERT_EQ(kit.complaints.size(), 2u);
    EXPECT_NE(kit.complaints[0].find("broken.json: json: "), std::string::npos);
    EXPECT_NE(kit.complaints[0].find("line 2"), std::string::npos) << kit.complaints[0];
    EXPECT_NE(kit.complaints[1].find("drift-1.json: id: "), std::string::npos);
    EXPECT_FALSE(kit.unreadable);
    std::filesystem::create_directory(folder.file("folder.json"));
    EXPECT_TRUE(read_kit(folder.path(), {}).value().unreadable);
}

TEST_F(ConformanceKit, AFolderWithoutCasesIsNoKit) {
    const ScratchFolder empty;
    EXPECT_EQ(read_kit(empty.path(), {}).error().fault, Fault::io);
    EXPECT_EQ(read_kit(empty.file("nothing"), {}).error().fault, Fault::io);
}

TEST_F(ConformanceKit, IsFoundWhereItIsStatedFirst) {
    EXPECT_EQ(find_conformance_folder("/stated").value(), "/stated");
    setenv("AXISCAL_CONFORMANCE_PATH", ("/nowhere-at-all:" + folder.path()).c_str(), 1);
    EXPECT_EQ(find_conformance_folder("").value(), folder.path());
    unsetenv("AXISCAL_CONFORMANCE_PATH");
}

} // namespace
} // namespace axiscal::kit_test
