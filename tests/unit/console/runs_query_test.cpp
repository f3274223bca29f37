#include "acquisition/console/runs_query.hpp"

#include <gtest/gtest.h>

#include <string>

namespace axiscal::runs_query_test {
namespace {

TEST(RunsQuery, APathIsTheListOneRunAPaperOrNothing) {
    EXPECT_EQ(runs_call_of("/v1/runs"), runs_path);
    EXPECT_EQ(runs_call_of("/v1/runs/demo-20261121T100000Z-X"), one_run_path);
    EXPECT_EQ(runs_call_of("/v1/runs/demo-1/certificate.pdf"), run_paper_path);
    for (const char* path : {"", "/", "/v1", "/v1/run", "/v1/runsX", "/v1/runs/", "/v1/runs//x",
                             "/v1/runs/x/y/z", "/v1/status"})
        EXPECT_EQ(runs_call_of(path), "") << path;
}

TEST(RunsQuery, WhatWouldLeaveTheFolderNamesNothing) {
    for (const char* path :
         {"/v1/runs/..", "/v1/runs/.hidden", "/v1/runs/../token", "/v1/runs/a/..",
          "/v1/runs/a/.receipt", "/v1/runs/%2e%2e", "/v1/runs/a%2Fb", "/v1/runs/a b",
          "/v1/runs/a\\b", "/v1/runs/a/../../token"})
        EXPECT_EQ(runs_call_of(path), "") << path;
    EXPECT_EQ(runs_call_of("/v1/runs/" + std::string(201, 'a')), "");
}

TEST(RunsQuery, IdAndPaperAreReadOffThePath) {
    const RunNamed named = run_named_in("/v1/runs/demo-1/certificate.json");
    EXPECT_EQ(named.id, "demo-1");
    EXPECT_EQ(named.paper, "certificate.json");
    EXPECT_EQ(run_named_in("/v1/runs/demo-1").paper, "");
}

TEST(RunsQuery, EachFieldMayBeLeftOut) {
    const auto nothing = runs_asked_of("/v1/runs");
    ASSERT_TRUE(nothing);
    EXPECT_EQ(nothing->limit, 20U);
    EXPECT_EQ(nothing->before + nothing->text, "");
    const auto all = runs_asked_of("/v1/runs?limit=7&before=demo-1&text=M%2D10442+X");
    ASSERT_TRUE(all);
    EXPECT_EQ(all->limit, 7U);
    EXPECT_EQ(all->before, "demo-1");
    EXPECT_EQ(all->text, "M-10442 X");
}

TEST(RunsQuery, AWrongFieldIsRefusedByItsName) {
    const auto field_of = [](const char* query) {
        const auto asked = runs_asked_of(std::string{"/v1/runs?"} + query);
        return asked ? std::string{"accepted"} : asked.error().field;
    };
    for (const char* query : {"limit=0", "limit=101", "limit=", "limit=-1", "limit=1x"})
        EXPECT_EQ(field_of(query), "limit") << query;
    EXPECT_EQ(field_of("before=../x"), "before");
    for (const char* query : {"text=%", "text=%4", "text=%zz", "text=%+1"})
        EXPECT_EQ(field_of(query), "text") << query;
    EXPECT_EQ(field_of(("text=" + std::string(201, 'a')).c_str()), "text");
    EXPECT_EQ(field_of("page=2"), "query");
}

TEST(RunsQuery, WhatIsNoUtf8BecomesValidText) {
    const auto asked = runs_asked_of("/v1/runs?text=%ff%00");
    ASSERT_TRUE(asked);
    EXPECT_EQ(asked->text, "\xEF\xBF\xBD ");
}

} // namespace
} // namespace axiscal::runs_query_test
