// What is said about certificate and key before anybody connects.
#include "acquisition/tls/tls_judgement.hpp"
#include "acquisition/tls/tls_loading.hpp"

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/tls/made_certificate.hpp"

#include <gtest/gtest.h>

#include <ctime>
#include <filesystem>
#include <sys/fsuid.h>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal::certificate_test {
namespace {

using test::make_certificate;
using test::write_secret;

/// Root reads everything; as long as this lives, files are opened by another user's rights.
class AsNobody {
public:
    AsNobody() {
        if (::geteuid() == 0) ::setfsuid(65534);
    }
    ~AsNobody() { ::setfsuid(::geteuid()); }
    AsNobody(const AsNobody&) = delete;
    AsNobody& operator=(const AsNobody&) = delete;
};

class Certificate : public ::testing::Test {
protected:
    void SetUp() override {
        const auto loaded = load_tls_module();
        ASSERT_TRUE(loaded) << loaded.error().detail;
        module = *loaded;
    }
    /// All sentences, "certificate! ..." where it refuses, "key: ..." where it is a note.
    std::string said(const TlsFiles& files) const {
        std::string words;
        for (const TlsFinding& finding : module->judge(files, std::time(nullptr)))
            words += std::string{finding.of_key ? "key" : "certificate"} +
                     (finding.refuses ? "! " : ": ") + finding.sentence + "\n";
        return words;
    }
    TlsFiles files_of(const test::MadeCertificate& made) const {
        return {write_secret(folder.path(), "certificate.pem", made.certificate),
                write_secret(folder.path(), "key.pem", made.key)};
    }
    static bool has(const std::string& text, const std::string& part) {
        return text.find(part) != std::string::npos;
    }

    testing::ScratchFolder folder;
    TlsModule* module = nullptr;
};

TEST_F(Certificate, APairThatFitsIsFine) {
    EXPECT_EQ(said(files_of(make_certificate())), "");
}

TEST_F(Certificate, AMissingFileIsNamed) {
    TlsFiles files = files_of(make_certificate());
    files.key += ".gone";
    EXPECT_TRUE(has(said(files), "key! " + files.key + " is not there")) << said(files);
    files.certificate += ".gone";
    EXPECT_TRUE(has(said(files), "certificate! ")) << said(files);
    EXPECT_TRUE(has(said(files), "key! ")) << said(files);
}

TEST_F(Certificate, AFolderOrAPipeIsNoFile) {
    TlsFiles files = files_of(make_certificate());
    files.certificate = folder.path();
    EXPECT_TRUE(has(said(files), folder.path() + " is no file")) << said(files);
    files.certificate = folder.file("pipe");
    ASSERT_EQ(::mkfifo(files.certificate.c_str(), 0600), 0);
    EXPECT_TRUE(has(said(files), "pipe is no file")) << said(files);
}

TEST_F(Certificate, AFileThatTheUserMayNotReadSaysSo) {
    const TlsFiles files = files_of(make_certificate());
    std::filesystem::permissions(files.key, std::filesystem::perms::none);
    const AsNobody user;
    EXPECT_TRUE(has(said(files), "the user whom axiscald runs as must read it")) << said(files);
}

TEST_F(Certificate, TheKeyOfAnotherCertificateIsRefused) {
    TlsFiles files = files_of(make_certificate());
    files.key = write_secret(folder.path(), "other.pem", make_certificate().key);
    EXPECT_TRUE(has(said(files), "key! " + files.key + " does not belong to")) << said(files);
}

TEST_F(Certificate, ALockedKeyIsRefusedWithoutAQuestion) {
    test::CertificateWanted wanted;
    wanted.pass_phrase = "swordfish";
    const std::string words = said(files_of(make_certificate(wanted)));
    EXPECT_TRUE(has(words, "key! ")) << words;
    EXPECT_TRUE(has(words, "pass phrase")) << words;
    EXPECT_TRUE(has(words, "openssl pkey")) << words;
}

TEST_F(Certificate, WhatIsNoPemIsRefused) {
    const test::MadeCertificate made = make_certificate();
    const std::string swapped = said(files_of({made.key, made.certificate}));
    EXPECT_TRUE(has(swapped, "certificate! ")) << swapped;
    const std::string no_key = said(files_of({made.certificate, "no key\n"}));
    EXPECT_TRUE(has(no_key, "holds no private key")) << no_key;
    EXPECT_TRUE(has(said(files_of({"", ""})), "certificate! "));
}

TEST_F(Certificate, OneThatHasEndedServesWithANote) {
    test::CertificateWanted wanted;
    wanted.begins_s = -2 * 24 * 3600;
    wanted.ends_s = -24 * 3600;
    const std::string words = said(files_of(make_certificate(wanted)));
    EXPECT_TRUE(words.starts_with("certificate: has ended on 20")) << words;
}

TEST_F(Certificate, OneThatHasNotBegunServesWithANote) {
    test::CertificateWanted wanted;
    wanted.begins_s = 24 * 3600;
    const std::string words = said(files_of(make_certificate(wanted)));
    EXPECT_TRUE(words.starts_with("certificate: begins only on 20")) << words;
}

TEST_F(Certificate, OneWithoutNamesServesWithANote) {
    test::CertificateWanted wanted;
    wanted.names_computer = false;
    const std::string words = said(files_of(make_certificate(wanted)));
    EXPECT_TRUE(has(words, "certificate: names no computer")) << words;
}

TEST_F(Certificate, AKeyThatEverybodyReadsServesWithANote) {
    const TlsFiles files = files_of(make_certificate());
    std::filesystem::permissions(files.key, std::filesystem::perms::others_read,
                                 std::filesystem::perm_options::add);
    EXPECT_TRUE(has(said(files), "key: " + files.key + " can be reached by everybody"));
}

TEST_F(Certificate, AStationFileIsToldWhere) {
    StationConfig station;
    station.file = "station.toml";
    EXPECT_TRUE(judge_tls(station, 0).refusals.empty());
    station.console.certificate = "/nowhere/fullchain.pem";
    station.console.key = "/nowhere/key.pem";
    station.console.certificate_line = 7;
    station.console.key_line = 8;
    const TlsJudgement judged = judge_tls(station, 0);
    ASSERT_EQ(judged.refusals.size(), 2U);
    EXPECT_TRUE(judged.refusals[0].describe().starts_with(
        "station.toml:7: console.certificate: /nowhere/fullchain.pem is not there"))
        << judged.refusals[0].describe();
    EXPECT_EQ(judged.refusals[1].line, 8);
}

TEST_F(Certificate, TheModuleIsOneAProcess) {
    const auto again = load_tls_module();
    ASSERT_TRUE(again);
    EXPECT_EQ(*again, module);
}

} // namespace
} // namespace axiscal::certificate_test
