#include "acquisition/runfile/digest.hpp"

#include "tests/support/scratch_folder.hpp"

#include <gtest/gtest.h>

namespace axiscal::digest_test {
namespace {

// FIPS 180-4 example "abc"; the million 'a' and the empty message are NIST's published vectors.
TEST(Digest, AgreesWithThePublishedExamples) {
    EXPECT_EQ(sha256_hex("abc"),
              "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256_hex(std::string(1'000'000, 'a')),
              "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Digest, OfAFileIsThatOfItsBytes) {
    const testing::ScratchFolder scratch;
    const std::string bytes(3'000'001, 'x'); // more than two blocks
    testing::write_bytes(scratch.file("f"), bytes);
    EXPECT_EQ(sha256_of_file(scratch.file("f")).value(), sha256_hex(bytes));
    EXPECT_EQ(sha256_of_file(scratch.file("none")).error().fault, Fault::io);
}

TEST(Digest, OfAFileThatSaysItIsEmptyIsThatOfWhatItHolds) {
    const testing::ScratchFolder scratch;
    testing::write_bytes(scratch.file("f"), "");
    EXPECT_EQ(sha256_of_file(scratch.file("f")).value(), sha256_hex(""));
    EXPECT_EQ(sha256_of_file("/proc/sys/kernel/ostype").value(), sha256_hex("Linux\n"));
}

TEST(Digest, OfALinkIsThatOfPreviousAndBytesInARow) {
    const Digest previous = sha256("before");
    EXPECT_EQ(sha256_link(previous, "row"),
              sha256(std::string{previous.begin(), previous.end()} + "row"));
}

} // namespace
} // namespace axiscal::digest_test
