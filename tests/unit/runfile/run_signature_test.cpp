#include "acquisition/runfile/run_signature.hpp"

#include "acquisition/runfile/run_file.hpp"
#include "acquisition/runfile/run_file_verify.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/runfile/random_run.hpp"
#include "tests/unit/runfile/written_run.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace axiscal::run_signature_test {
namespace {

using testing::RandomRun;
using testing::run_sql;
using testing::ScratchFolder;
using testing::write_run;

const SecretKey station{SecretKey::Seed{1, 2, 3}}, another{SecretKey::Seed{4, 5, 6}};
const std::vector<PublicKey> known{station.public_key()};

/// Two points, closed with a signature, and a result of it.
void write_signed(const std::string& path, unsigned seed, const SecretKey* key = &station) {
    RandomRun random{seed};
    write_run(path, random, 2, false);
    auto writer = RunFileWriter::reopen(path).value();
    ASSERT_TRUE(writer.close(true, "done", random.tie(), key));
    ASSERT_TRUE(store_result(path, {"d", "{}"}, key));
}

SignatureReport judged(const std::string& path, std::span<const PublicKey> keys = known) {
    return check_signatures(path, keys).value();
}

TEST(RunSignature, OfAClosedRunIsGoodUnderTheStationsKeyAndUnknownWithoutIt) {
    const ScratchFolder scratch;
    const auto path = scratch.file("r.axiscal");
    write_signed(path, 1);
    EXPECT_EQ(judged(path).verdict, SignatureVerdict::good) << judged(path).sentence;
    EXPECT_EQ(judged(path, {}).verdict, SignatureVerdict::unknown_key);
    EXPECT_TRUE(verify_chain(path)->intact());
    EXPECT_TRUE(read_run_file(path));
}

TEST(RunSignature, OfAnotherStationIsBad) {
    const ScratchFolder scratch;
    const auto path = scratch.file("r.axiscal");
    write_signed(path, 2, &another);
    EXPECT_EQ(judged(path).verdict, SignatureVerdict::bad);
    EXPECT_NE(judged(path).sentence.find(short_name_of(another.public_key())), std::string::npos);
    EXPECT_EQ(judged(path, {}).verdict, SignatureVerdict::unknown_key);
}

TEST(RunSignature, IsAbsentWhereNobodySigned) {
    const ScratchFolder scratch;
    const auto path = scratch.file("r.axiscal");
    write_signed(path, 3, nullptr);
    EXPECT_EQ(judged(path).verdict, SignatureVerdict::absent);
}

TEST(RunSignature, StandsFromTheMomentOfTheClosing) {
    const ScratchFolder scratch;
    const auto path = scratch.file("r.axiscal");
    RandomRun random{5};
    write_run(path, random, 2, false);
    EXPECT_EQ(judged(path).verdict, SignatureVerdict::absent);
    auto writer = RunFileWriter::reopen(path).value();
    ASSERT_TRUE(writer.close(false, "aborted", random.tie(), &station));
    EXPECT_EQ(judged(path).verdict, SignatureVerdict::good);
}

TEST(RunSignature, IsMadeAnewAtEachClosing) {
    const ScratchFolder scratch;
    const auto path = scratch.file("r.axiscal");
    write_signed(path, 6);
    RandomRun random{7};
    RunBatch first;
    first.exclusions.push_back({0, random.tie().before, 0, "a door was open"});
    auto writer = RunFileWriter::reopen_closed(path, first).value();
    ASSERT_TRUE(writer.close(true, "done", random.tie(), &station));
    EXPECT_EQ(judged(path).verdict, SignatureVerdict::good) << judged(path).sentence;
    ASSERT_TRUE(store_result(path, {"e", "{}"}, &station));
    EXPECT_EQ(judged(path).verdict, SignatureVerdict::good) << judged(path).sentence;
    run_sql(path, "DELETE FROM signature WHERE closing=2");
    EXPECT_EQ(judged(path).verdict, SignatureVerdict::bad);
    EXPECT_NE(judged(path).sentence.find("closing 2 bears no signature"), std::string::npos);
}

TEST(RunSignature, OfAResultCannotBeLeftOut) {
    const ScratchFolder scratch;
    const auto path = scratch.file("r.axiscal");
    write_signed(path, 8);
    const auto refused = store_result(path, {"f", "{}"});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().fault, Fault::refused);
    run_sql(path, "INSERT INTO result(digest, document, hash) VALUES('f', '{}', x'00')");
    EXPECT_EQ(judged(path).verdict, SignatureVerdict::bad);
    EXPECT_NE(judged(path).sentence.find("result 2 bears no signature"), std::string::npos);
}

TEST(RunSignature, SeesEachSignedFieldThatWasChanged) {
    for (const std::string change :
         {"UPDATE run SET run_id = run_id || 'x'", "UPDATE closing SET hash = zeroblob(32)",
          "UPDATE result SET hash = zeroblob(32)", "UPDATE signature SET closing = 2",
          "UPDATE signature SET closing = 0", "UPDATE signature SET closing_hash = zeroblob(32)",
          "UPDATE signature SET result_hash = zeroblob(32) WHERE result_hash IS NOT NULL",
          "UPDATE signature SET result_hash = NULL", "UPDATE signature SET result_hash = x'00'",
          "UPDATE signature SET public_key = zeroblob(32)",
          "UPDATE signature SET signature = zeroblob(64)", "UPDATE signature SET signature = x''",
          "DELETE FROM signature WHERE id = 1", "DELETE FROM signature WHERE id = 2",
          "DELETE FROM result", "DELETE FROM closing"}) {
        const ScratchFolder scratch;
        const auto path = scratch.file("r.axiscal");
        write_signed(path, 9);
        run_sql(path, change);
        const auto report = judged(path);
        // The first signature, of the closing alone, is covered by that of the result.
        const bool covered = change == "DELETE FROM signature WHERE id = 1";
        EXPECT_EQ(report.verdict, covered ? SignatureVerdict::good : SignatureVerdict::bad)
            << change << ": " << report.sentence;
    }
}

TEST(Anchor, IsMetByTheRunThatWasPublishedAndByWhatWasAddedLater) {
    const ScratchFolder scratch;
    const auto path = scratch.file("r.axiscal");
    write_signed(path, 10);
    const ClosingMark published = last_closing_mark(path).value();
    EXPECT_EQ(published.closing, 1);
    EXPECT_EQ(compare_with_anchor(path, published)->verdict, AnchorVerdict::match);
    RandomRun random{11};
    RunBatch first;
    first.exclusions.push_back({0, random.tie().before, 0, "a door was open"});
    auto writer = RunFileWriter::reopen_closed(path, first).value();
    EXPECT_FALSE(last_closing_mark(path)) << "it is open";
    ASSERT_TRUE(writer.close(true, "done", random.tie(), &station));
    ASSERT_TRUE(store_result(path, {"e", "{}"}, &station));
    EXPECT_EQ(compare_with_anchor(path, published)->verdict, AnchorVerdict::match);
}

TEST(Anchor, DiffersForEachFieldThatIsAnother) {
    const ScratchFolder scratch;
    const auto path = scratch.file("r.axiscal");
    write_signed(path, 12);
    const ClosingMark right = last_closing_mark(path).value();
    const auto differs = [&](auto change) {
        ClosingMark mark = right;
        change(mark);
        return compare_with_anchor(path, mark)->verdict == AnchorVerdict::differs;
    };
    EXPECT_TRUE(differs([](ClosingMark& mark) { mark.run_id += "x"; }));
    EXPECT_TRUE(differs([](ClosingMark& mark) { mark.closing = 2; }));
    EXPECT_TRUE(differs([](ClosingMark& mark) { mark.closing = 0; }));
    EXPECT_TRUE(differs([](ClosingMark& mark) { mark.closing_hash[31] ^= 1U; }));
    EXPECT_TRUE(differs([](ClosingMark& mark) { (*mark.result_hash)[0] ^= 1U; }));
}

} // namespace
} // namespace axiscal::run_signature_test
