#include "acquisition/console/peer.hpp"

#include "tests/support/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace axiscal::peer_test {
namespace {

using testing::ScratchFolder;

TEST(UserName, IsThatOfTheFileAndEmptyForOneThatItDoesNotName) {
    const ScratchFolder scratch;
    const std::string path = scratch.file("passwd");
    std::ofstream{path} << "root:x:0:0:root:/root:/bin/bash\n"
                           "jo:x:1000:1000:Jo Miller,,,:/home/jo:/bin/bash\n";
    EXPECT_EQ(user_name_of(1000, path), "jo");
    EXPECT_EQ(user_name_of(0, path), "root");
    EXPECT_EQ(user_name_of(1001, path), "");
    EXPECT_EQ(user_name_of(0, scratch.file("nothing")), "");
}

TEST(Orderer, IsToldInWordsWithWhatIsKnown) {
    EXPECT_EQ(name_of(Orderer{"socket", 1000, "jo", "Jo Miller"}), "Jo Miller (user jo, uid 1000)");
    EXPECT_EQ(name_of(Orderer{"socket", 1000, "jo", ""}), "user jo, uid 1000");
    EXPECT_EQ(name_of(Orderer{"socket", 4711, "", "Jo"}), "Jo (uid 4711)");
    EXPECT_EQ(name_of(Orderer{"token", std::nullopt, "", "Jo"}), "Jo (token)");
    EXPECT_EQ(name_of(Orderer{"token", std::nullopt, "", ""}), "token");
    EXPECT_EQ(name_of(Orderer{"page", std::nullopt, "tablet 2", ""}), "page tablet 2");
    EXPECT_EQ(name_of(Orderer{"page", std::nullopt, "tablet 2", "Jo"}), "Jo (page tablet 2)");
    EXPECT_EQ(name_of(Orderer{"page", std::nullopt, "page", ""}), "page");
    EXPECT_EQ(name_of(Orderer{}), "not known");
}

} // namespace
} // namespace axiscal::peer_test
