#include "acquisition/console/accepted_encoding.hpp"

#include <gtest/gtest.h>

namespace axiscal::accepted_encoding_test {
namespace {

TEST(AcceptedEncoding, WhoNamesGzipTakesIt) {
    for (const char* field :
         {"gzip", "gzip, deflate, br, zstd", "deflate, gzip", "GZip", "x-gzip", "gzip;q=1",
          "gzip;q=1.000", "gzip; q=0.001", "gzip \t;\tQ=1.", "br;q=1.0, gzip;q=0.8, *;q=0.1",
          "gzip;q=0.5, identity;q=0.5", "identity;q=0, gzip;q=0.1", ",, gzip ,"})
        EXPECT_TRUE(takes_gzip(field)) << field;
}

TEST(AcceptedEncoding, WhoTakesEverythingTakesIt) {
    for (const char* field :
         {"*", "*;q=0.1", "br, *", "identity;q=0.2, *;q=0.3", "identity;q=0, *"})
        EXPECT_TRUE(takes_gzip(field)) << field;
}

TEST(AcceptedEncoding, WhoDoesNotNameItGetsTheFile) {
    for (const char* field : {"", " ", ",", "identity", "deflate, br", "gzipped", "gzi", "pgzip",
                              "identity;q=0", "br;q=0"})
        EXPECT_FALSE(takes_gzip(field)) << field;
}

TEST(AcceptedEncoding, AWeightOfNothingIsARefusal) {
    for (const char* field :
         {"gzip;q=0", "gzip;q=0.000", "gzip;q=0.", "*;q=0", "gzip;q=0, *", "*, gzip ; q=0",
          "gzip, gzip;q=0", "gzip;q=0, gzip", "x-gzip;q=0, gzip", "br, x-gzip;q=0, *;q=1"})
        EXPECT_FALSE(takes_gzip(field)) << field;
}

TEST(AcceptedEncoding, WhoPrefersTheFileGetsTheFile) {
    for (const char* field : {"identity, gzip;q=0.5", "gzip;q=0.999, identity;q=1",
                              "identity, *;q=0.5", "gzip;q=0.2, *;q=0.3"})
        EXPECT_FALSE(takes_gzip(field)) << field;
}

TEST(AcceptedEncoding, WhatBreaksTheGrammarGetsTheFile) {
    for (const char* field :
         {"gzip;",          "gzip;q",       "gzip;q=",      "gzip;q=2",     "gzip;q=1.001",
          "gzip;q=0.0001",  "gzip;q=.5",    "gzip;q=-1",    "gzip;q=+1",    "gzip;q=0x1",
          "gzip;q = 1",     "gzip;q=\"1\"", "gzip;level=9", "gzip;q=1;q=0", "gzip q=1",
          "gz ip",          "gzip br",      "gzip, \"br\"", "gzip;;q=1",    "gzip, br/1",
          "gzip, \xc3\xa4", "gzip;q=1e0",   "gzip\n",       "gzip, ;q=1"})
        EXPECT_FALSE(takes_gzip(field)) << field;
}

} // namespace
} // namespace axiscal::accepted_encoding_test
