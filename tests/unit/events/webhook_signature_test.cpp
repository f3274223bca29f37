// The signature against the vector that the libraries of Standard Webhooks share.

#include "acquisition/events/webhook_signature.hpp"
#include "tests/support/scratch_folder.hpp"

#include <gtest/gtest.h>
#include <string>
#include <sys/stat.h>

namespace axiscal::webhook_signature_test {
namespace {

// github.com/standard-webhooks/standard-webhooks, the test of signing in each of its libraries.
const std::string published_secret = "whsec_MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLaSw";
const std::string published_signature = "v1,g0hM9SsE+OTPJTGt/tmIKtSyZlE3uFJELVlNIOLJ1OE=";

std::vector<WebhookKey> keys_of(const std::string& text) {
    auto keys = parse_webhook_secret(text, "secret");
    EXPECT_TRUE(keys) << (keys ? "" : keys.error().detail);
    return keys.value_or(std::vector<WebhookKey>{});
}

std::string signed_by(const std::string& secrets) {
    return webhook_signatures(keys_of(secrets), "msg_p5jXN8AQM9LWM0D4loKWxJek", 1614265330,
                              R"({"test": 2432232314})");
}

TEST(WebhookSignature, IsThePublishedOne) {
    EXPECT_EQ(signed_by(published_secret), published_signature);
}

TEST(WebhookSignature, OfTwoSecretsBothSign) {
    const std::string both = signed_by("# old\n" + published_secret + "\r\n\n" +
                                       "whsec_AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA\n");
    EXPECT_TRUE(both.starts_with(published_signature + " v1,")) << both;
    EXPECT_EQ(both.size(), 2 * published_signature.size() + 1);
}

TEST(WebhookSecret, IsRefusedByFileAndLineWithoutBeingQuoted) {
    for (const std::string secret : {"MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLaSw", "whsec_c2hvcnQ=",
                                     "whsec_no base64 at all, however long it may be",
                                     "whsec_MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLaS"}) {
        const auto keys = parse_webhook_secret("# a line\n" + secret + "\n", "hook.secret");
        ASSERT_FALSE(keys) << secret;
        EXPECT_TRUE(keys.error().detail.starts_with("hook.secret:2: ")) << keys.error().detail;
        EXPECT_EQ(keys.error().detail.find(secret), std::string::npos);
    }
    EXPECT_FALSE(parse_webhook_secret("", "s"));
    const std::string line = published_secret + "\n";
    EXPECT_FALSE(parse_webhook_secret(line + line + line, "s"));
}

TEST(WebhookSecret, IsReadFromAFileThatNobodyElseMayRead) {
    const testing::ScratchFolder folder;
    const std::string path = folder.file("secret");
    testing::write_bytes(path, published_secret + "\n");
    ASSERT_EQ(::chmod(path.c_str(), 0640), 0);
    const auto open_to_others = read_webhook_secret(path);
    ASSERT_FALSE(open_to_others);
    EXPECT_EQ(open_to_others.error().fault, Fault::refused);
    ASSERT_EQ(::chmod(path.c_str(), 0600), 0);
    EXPECT_EQ(read_webhook_secret(path).value(), keys_of(published_secret));
    EXPECT_FALSE(read_webhook_secret(folder.path()));
    EXPECT_FALSE(read_webhook_secret(folder.file("none")));
}

} // namespace
} // namespace axiscal::webhook_signature_test
