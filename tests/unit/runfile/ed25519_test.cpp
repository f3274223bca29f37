#include "acquisition/runfile/ed25519.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace axiscal::ed25519_test {
namespace {

template <std::size_t count> std::array<std::uint8_t, count> bytes_of(const std::string& hex) {
    std::array<std::uint8_t, count> bytes{};
    EXPECT_EQ(hex.size(), 2 * count);
    for (std::size_t i = 0; i < count; ++i)
        bytes[i] = static_cast<std::uint8_t>(std::stoi(hex.substr(2 * i, 2), nullptr, 16));
    return bytes;
}

std::string text_of(const std::string& hex) {
    std::string text;
    for (std::size_t i = 0; i < hex.size(); i += 2)
        text += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
    return text;
}

struct Vector {
    const char *secret, *key, *message, *signature;
};

/// RFC 8032, section 7.1: TEST 1, TEST 2, TEST 3 and TEST SHA(abc).
constexpr std::array vectors{
    Vector{"9d61b19deffd5a60ba844af492ec2cc44449c5697b326919703bac031cae7f60",
           "d75a980182b10ab7d54bfed3c964073a0ee172f3daa62325af021a68f707511a", "",
           "e5564300c360ac729086e2cc806e828a84877f1eb8e5d974d873e065224901555fb8821590a33bacc61e397"
           "01cf9b46bd25bf5f0595bbe24655141438e7a100b"},
    Vector{"4ccd089b28ff96da9db6c346ec114e0f5b8a319f35aba624da8cf6ed4fb8a6fb",
           "3d4017c3e843895a92b70aa74d1b7ebc9c982ccf2ec4968cc0cd55f12af4660c", "72",
           "92a009a9f0d4cab8720e820b5f642540a2b27b5416503f8fb3762223ebdb69da085ac1e43e15996e458f36"
           "13d0f11d8c387b2eaeb4302aeeb00d291612bb0c00"},
    Vector{"c5aa8df43f9f837bedb7442f31dcb7b166d38535076f094b85ce3a2e0b4458f7",
           "fc51cd8e6218a1a38da47ed00230f0580816ed13ba3303ac5deb911548908025", "af82",
           "6291d657deec24024827e69c3abe01a30ce548a284743a445e3680d7db5ac3ac18ff9b538d16f290ae67f7"
           "60984dc6594a7c15e9716ed28dc027beceea1ec40a"},
    Vector{"833fe62409237b9d62ec77587520911e9a759cec1d19755b7da901b96dca3d42",
           "ec172b93ad5e563bf4932c70e1245034c35467ef2efd4d64ebf819683467e2bf",
           "ddaf35a193617abacc417349ae20413112e6fa4e89a97ea20a9eeee64b55d39a2192992a274fc1a836ba3c2"
           "3a3feebbd454d4423643ce80e2a9ac94fa54ca49f",
           "dc2a4459e7369633a52b1bf277839a00201009a3efbf3ecb69bea2186c26b58909351fc9ac90b3ecfdfbc7"
           "c66431e0303dca179c138ac17ad9bef1177331a704"}};

TEST(Ed25519, GivesTheKnownAnswersOfRfc8032) {
    for (const auto& [secret, key, message, signature] : vectors) {
        const SecretKey made{bytes_of<32>(secret)};
        EXPECT_EQ(made.public_key(), bytes_of<32>(key));
        EXPECT_EQ(made.sign(text_of(message)), bytes_of<64>(signature));
        EXPECT_TRUE(is_signed_by(bytes_of<32>(key), text_of(message), bytes_of<64>(signature)));
    }
}

TEST(Ed25519, RefusesEachChangedBitOfMessageKeyAndSignature) {
    const auto& [secret, key, message, signature] = vectors[2];
    const auto right = bytes_of<64>(signature);
    for (std::size_t bit = 0; bit < 512; ++bit) {
        auto wrong = right;
        wrong[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
        EXPECT_FALSE(is_signed_by(bytes_of<32>(key), text_of(message), wrong)) << bit;
    }
    for (std::size_t bit = 0; bit < 256; ++bit) {
        auto wrong = bytes_of<32>(key);
        wrong[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
        EXPECT_FALSE(is_signed_by(wrong, text_of(message), right)) << bit;
    }
    EXPECT_FALSE(is_signed_by(bytes_of<32>(key), text_of("af83"), right));
    EXPECT_FALSE(is_signed_by(bytes_of<32>(key), "", right));
}

/// RFC 8410, section 10.1: the public key of the example.
constexpr const char* example_of_rfc_8410 =
    "-----BEGIN PUBLIC KEY-----\n"
    "MCowBQYDK2VwAyEAGb9ECWmEzf6FQbrBZ9w7lshQhqowtrbLDFw4rXAxZuE=\n"
    "-----END PUBLIC KEY-----\n";

TEST(PublicKey, IsTheExampleOfRfc8410) {
    const auto keys = public_keys_of(example_of_rfc_8410);
    ASSERT_TRUE(keys);
    ASSERT_EQ(keys->size(), 1U);
    EXPECT_EQ(keys->front(),
              bytes_of<32>("19bf44096984cdfe8541bac167dc3b96c85086aa30b6b6cb0c5c38ad7"
                           "03166e1"));
    EXPECT_EQ(to_pem(keys->front()), example_of_rfc_8410);
}

TEST(PublicKey, IsFoundAmongOthersAndBetweenWords) {
    const PublicKey second = SecretKey{bytes_of<32>(vectors[0].secret)}.public_key();
    const auto keys =
        public_keys_of("bay 3, since May\n" + std::string{example_of_rfc_8410} + to_pem(second));
    ASSERT_TRUE(keys);
    ASSERT_EQ(keys->size(), 2U);
    EXPECT_EQ(keys->back(), second);
}

TEST(PublicKey, OfAnotherKindOrDamagedIsRefused) {
    std::string cut = example_of_rfc_8410, damaged = cut;
    cut.erase(cut.size() - 26);
    damaged[30] = '!';
    for (const std::string& text :
         {std::string{}, std::string{"-----BEGIN PRIVATE KEY-----\n"}, cut, damaged,
          std::string{"-----BEGIN PUBLIC KEY-----\nAAAA\n-----END PUBLIC KEY-----\n"}}) {
        const auto keys = public_keys_of(text);
        ASSERT_FALSE(keys) << text;
        EXPECT_NE(keys.error().detail.find("public-keys.pem"), std::string::npos);
    }
}

} // namespace
} // namespace axiscal::ed25519_test
