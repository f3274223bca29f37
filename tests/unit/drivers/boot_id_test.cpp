// What the kernel writes into /proc/sys/kernel/random/boot_id, random(4): a UUID and a line's end.
#include "drivers/boot_id.hpp"

#include "tests/support/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace axiscal::boot_id_test {
namespace {

constexpr const char* some_uuid = "3a5b0c1e-9f27-4d6a-8b10-7c2e5f419d03";

BootId read_from(const std::string& content) {
    const testing::ScratchFolder scratch;
    const std::string path = scratch.file("boot_id");
    std::ofstream{path} << content;
    return read_boot_id(path);
}

TEST(BootIdOfTheKernel, IsReadWithoutItsLinesEnd) {
    EXPECT_EQ(read_from(std::string{some_uuid} + "\n").text, some_uuid);
    EXPECT_TRUE(is_same_boot(read_from(some_uuid), read_from(some_uuid)));
    EXPECT_TRUE(read_boot_id().known()) << "of the computer that runs the tests";
}

TEST(BootIdOfTheKernel, ThatIsHiddenEmptyOrNoUuidIsUnknownAndEqualToNothing) {
    const BootId hidden = read_boot_id("/proc/self/no such file");
    EXPECT_FALSE(hidden.known());
    EXPECT_FALSE(is_same_boot(hidden, hidden));
    EXPECT_FALSE(is_same_boot(hidden, {some_uuid}));
    EXPECT_FALSE(is_same_boot({some_uuid}, hidden));
    for (const char* text :
         {"", "\n", "unknown", "3a5b0c1e-9f27-4d6a-8b10-7c2e5f419d0",
          "3a5b0c1e-9f27-4d6a-8b10-7c2e5f419d03 or so", "00000000-0000-0000-0000-000000000000"})
        EXPECT_FALSE(read_from(text).known()) << text;
}

} // namespace
} // namespace axiscal::boot_id_test
