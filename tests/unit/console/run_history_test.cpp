// Stored runs as a list shows them, made by the writer of run files itself.
#include "acquisition/console/run_history.hpp"

#include "acquisition/console/stored_run_json.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/runfile/one_row.hpp"
#include "tests/unit/runfile/random_run.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <filesystem>
#include <sys/stat.h>

namespace axiscal::run_history_test {
namespace {

using testing::append;
using testing::RandomRun;
using testing::ScratchFolder;
using testing::write_bytes;

const std::string older = "demo-20260101T080000Z-X", newer = "demo-20260102T080000Z-Y";

class StoredRunHistory : public ::testing::Test {
protected:
    void SetUp() override {
        for (const char* folder : {"runs", "outbox", "published"})
            std::filesystem::create_directory(scratch.file(folder));
    }
    [[nodiscard]] std::string run_file(const std::string& id) const {
        return scratch.file("runs/" + id + ".axiscal");
    }
    RunFileWriter begin(const std::string& id) {
        RunRecord run = random.header();
        run.run_id = id;
        run.kind = TestKind::positioning;
        run.statements.machine = "M-10442";
        run.statements.machine_serial = "4711";
        run.statements.state = "as found";
        run.statements.axis = id.substr(id.size() - 1);
        RunFileWriter writer = RunFileWriter::create(run_file(id), run).value();
        EXPECT_TRUE(append(writer, random.point(0)));
        return writer;
    }
    void store(const std::string& id, bool complete = true) {
        RunFileWriter writer = begin(id);
        EXPECT_TRUE(writer.close(complete, complete ? "done" : "coolant", random.tie()));
    }
    void certify(const std::string& place,
                 const std::string& run,
                 const std::string& digest = "ab") const {
        std::filesystem::create_directory(scratch.file(place));
        write_bytes(
            scratch.file(place + "/certificate.json"),
            R"({"unit":"mm","parameters":{"A":{"value":0.01}},"verdict":"pass","verdicts":[],)"
            R"("run":{"id":")" +
                run + R"(","result_digest":")" + digest + R"("}})");
        write_bytes(scratch.file(place + "/certificate.pdf"), "%PDF-1.5");
        write_bytes(scratch.file(place + "/receipt.json"), "{}");
    }
    RunsPage page(RunsAsked asked = {}, const OpenRuns& open = {}) {
        return history.page(asked, open);
    }

    ScratchFolder scratch;
    RandomRun random{20260102};
    RunHistory history{scratch.path()};
};

TEST_F(StoredRunHistory, IsEmptyWithoutRunsAndWithoutTheirFolder) {
    EXPECT_TRUE(page().runs.empty());
    std::filesystem::remove(scratch.file("runs"));
    EXPECT_TRUE(page().runs.empty());
    EXPECT_EQ(page().next, "");
}

TEST_F(StoredRunHistory, TheNewestComesFirstWithWhatItsFileStates) {
    store(older);
    store(newer, false);
    const RunsPage shown = page();
    ASSERT_EQ(shown.runs.size(), 2U);
    EXPECT_EQ(shown.runs[0].id, newer);
    EXPECT_EQ(shown.runs[0].status, StoredStatus::incomplete);
    EXPECT_EQ(shown.runs[0].sentence, "coolant");
    EXPECT_EQ(shown.runs[1].status, StoredStatus::complete);
    EXPECT_EQ(shown.runs[1].summary->machine_serial, "4711");
    EXPECT_EQ(shown.runs[1].summary->machine_state, "as found");
}

TEST_F(StoredRunHistory, ACertificateIsFoundInTheOutboxAndWherePublishedOnesLie) {
    store(older);
    store(newer);
    certify("outbox/" + newer, newer);
    certify("published/" + older, older);
    const RunsPage shown = page();
    ASSERT_EQ(shown.runs.size(), 2U);
    EXPECT_EQ(shown.runs[0].paper, PaperState::waiting);
    EXPECT_EQ(shown.runs[1].paper, PaperState::published);
    EXPECT_EQ(shown.runs[1].facts->verdict, "pass");
    std::filesystem::rename(scratch.file("outbox/" + newer), scratch.file("published/" + newer));
    EXPECT_EQ(page().runs[0].paper, PaperState::published);
}

TEST_F(StoredRunHistory, WithoutACertificateNoFigureIsToldButHowItIsMade) {
    store(older);
    const RunsPage shown = page();
    ASSERT_EQ(shown.runs.size(), 1U);
    EXPECT_EQ(shown.runs[0].paper, PaperState::none);
    EXPECT_FALSE(shown.runs[0].facts);
    EXPECT_NE(shown.runs[0].paper_sentence.find("axiscal export " + older), std::string::npos);
}

TEST_F(StoredRunHistory, TheCertificateOfAnotherRunOrAnotherEvaluationIsNotShown) {
    store(older);
    certify("published/" + older, newer);
    EXPECT_NE(page().runs.at(0).paper_sentence.find("is the one of run " + newer),
              std::string::npos);
    certify("published/" + older + "-2", older, "ab");
    EXPECT_TRUE(page().runs.at(0).facts);
    ASSERT_TRUE(store_result(run_file(older), {"cd", "{}"}));
    // The clock of a file system may stand still for some milliseconds.
    std::filesystem::last_write_time(
        run_file(older), std::filesystem::file_time_type::clock::now() + std::chrono::seconds{1});
    EXPECT_FALSE(page().runs.at(0).facts);
    EXPECT_EQ(page().runs.at(0).paper, PaperState::none);
}

TEST_F(StoredRunHistory, ADamagedFileIsOneRowWithItsSentenceAndNoPath) {
    store(older);
    write_bytes(run_file(newer), "no run file at all");
    const RunsPage shown = page();
    ASSERT_EQ(shown.runs.size(), 2U);
    EXPECT_EQ(shown.runs[0].status, StoredStatus::unreadable);
    EXPECT_FALSE(shown.runs[0].sentence.empty());
    EXPECT_EQ(shown.runs[0].sentence.find(scratch.path()), std::string::npos);
    EXPECT_EQ(shown.runs[1].status, StoredStatus::complete);
}

TEST_F(StoredRunHistory, APipeAndALinkToNothingAreRowsAndHoldUpNothing) {
    ASSERT_EQ(::mkfifo(run_file(older).c_str(), 0600), 0);
    std::filesystem::create_symlink("/nowhere", run_file(newer));
    for (const StoredRun& run : page().runs)
        EXPECT_EQ(run.status, StoredStatus::unreadable) << run.id;
}

TEST_F(StoredRunHistory, AnOpenRunIsARowAndItsFileIsNotOpened) {
    const RunFileWriter writer = begin(older); // its log lies beside it
    EXPECT_EQ(page().runs.at(0).status, StoredStatus::open);
    store(newer);
    EXPECT_EQ(page({}, {newer}).runs.at(0).status, StoredStatus::open);
    EXPECT_EQ(page().runs.at(0).status, StoredStatus::complete);
}

TEST_F(StoredRunHistory, PagesFollowEachOtherWithoutAGap) {
    store(older);
    store(newer);
    RunsAsked asked;
    asked.limit = 1;
    const RunsPage first = page(asked);
    ASSERT_EQ(first.runs.size(), 1U);
    EXPECT_EQ(first.next, newer);
    asked.before = first.next;
    const RunsPage second = page(asked);
    ASSERT_EQ(second.runs.size(), 1U);
    EXPECT_EQ(second.runs[0].id, older);
    EXPECT_EQ(second.next, "");
}

TEST_F(StoredRunHistory, ASearchLooksIntoEachRowInAnyCase) {
    store(older);
    store(newer);
    const auto found = [this](const std::string& text) {
        RunsAsked asked;
        asked.text = text;
        return page(asked).runs.size();
    };
    EXPECT_EQ(found("m-10442"), 2U);
    EXPECT_EQ(found("4711 AS FOUND positioning"), 2U);
    EXPECT_EQ(found("20260102"), 1U);
    EXPECT_EQ(found("4712"), 0U);
}

TEST_F(StoredRunHistory, AtMostTwoHundredFilesAreOpenedForOnePage) {
    for (int i = 0; i < 205; ++i)
        write_bytes(run_file("r" + std::to_string(1000 + i)), "x");
    RunsAsked asked;
    asked.text = "found in none";
    const RunsPage first = page(asked);
    EXPECT_TRUE(first.runs.empty());
    EXPECT_EQ(first.next, "r1005");
    asked.before = first.next;
    EXPECT_EQ(page(asked).next, "");
}

TEST_F(StoredRunHistory, ANameThatNoRunIsGivenIsCounted) {
    write_bytes(scratch.file("runs/a b.axiscal"), "x");
    write_bytes(scratch.file("runs/.hidden.axiscal"), "x");
    EXPECT_EQ(page().passed_over, 1U);
}

TEST_F(StoredRunHistory, OneRunHasItsPapersAndTheCertificateByteForByte) {
    store(older);
    certify("published/" + older, older);
    const auto found = history.one(older, {});
    ASSERT_TRUE(found) << describe(found.error());
    ASSERT_EQ(found->papers.size(), 2U); // the receipt is none
    EXPECT_EQ(found->papers[0].name, "certificate.pdf");
    const std::string text = run_with_papers_text(*found);
    EXPECT_NE(text.find(found->certificate), std::string::npos);
    const auto json = nlohmann::json::parse(text, nullptr, false);
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json.at("certificate").at("run").at("id"), older);
    EXPECT_EQ(text.find(scratch.path()), std::string::npos);
}

TEST_F(StoredRunHistory, AnIncompleteRunHasNoVerdictWhateverAPaperOfItSays) {
    store(older, false);
    certify("published/" + older, older);
    const auto json = to_json(page().runs.at(0));
    EXPECT_EQ(json.at("verdict"), "");
    EXPECT_EQ(json.at("status"), "incomplete");
}

TEST_F(StoredRunHistory, APaperIsLookedUpAmongThoseThatAreThere) {
    store(older);
    certify("published/" + older, older);
    const auto pdf = history.paper({older, "certificate.pdf"}, {});
    ASSERT_TRUE(pdf) << describe(pdf.error());
    EXPECT_EQ(pdf->bytes, "%PDF-1.5");
    EXPECT_EQ(pdf->file_name, older + ".pdf");
    for (const char* name : {"receipt.json", "certificate.csv", "certificate.pdf2"}) {
        const auto none = history.paper({older, name}, {});
        ASSERT_FALSE(none) << name;
        EXPECT_EQ(none.error().fault, Fault::not_found);
    }
    EXPECT_EQ(history.paper({newer, "certificate.pdf"}, {}).error().fault, Fault::not_found);
}

} // namespace
} // namespace axiscal::run_history_test
