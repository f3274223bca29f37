#include "acquisition/console/http_page.hpp"
#include "acquisition/console/page_files.hpp"

#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_dir.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace axiscal::page_files_test {
namespace {

namespace http = boost::beast::http;
using testing::ScratchFolder;
using testing::write_bytes;

ScratchFolder& with_page(ScratchFolder& folder) {
    std::filesystem::create_directory(folder.file("languages"));
    write_bytes(folder.file("index.html"), "<!doctype html>");
    write_bytes(folder.file("main.js"), "export {};");
    write_bytes(folder.file("languages/en.json"), "{}");
    return folder;
}

HttpRequest asked(const std::string& target) {
    HttpRequest request{http::verb::get, target, 11};
    request.set(http::field::host, "localhost");
    return request;
}

std::string field_of(const HttpResponse& response, const std::string& name) {
    const auto found = response.find(name);
    return found == response.end() ? std::string{} : std::string{found->value()};
}

TEST(PageFiles, TheRootIsTheIndexAndEachFileHasItsType) {
    ScratchFolder folder;
    const auto page = PageFiles::read(with_page(folder).path());
    ASSERT_TRUE(page) << describe(page.error());
    EXPECT_EQ(page->count(), 3U);
    EXPECT_EQ(page->find("/")->type, "text/html; charset=utf-8");
    EXPECT_EQ(page->find("/page/main.js")->type, "text/javascript; charset=utf-8");
    EXPECT_EQ(page->find("/page/main.js")->bytes(), "export {};");
    EXPECT_EQ(page->find("/page/languages/en.json")->type, "application/json; charset=utf-8");
}

TEST(PageFiles, NoAskedPathLeavesTheFolder) {
    ScratchFolder folder;
    const auto page = PageFiles::read(with_page(folder).path());
    ASSERT_TRUE(page);
    for (const char* path :
         {"", "/page", "/page/", "/page/index.html", "/page/../index.html", "/page//main.js",
          "/page/%2e%2e/main.js", "/page/./main.js", "//page/main.js", "/page/main.js%00",
          "/page/MAIN.JS", "/etc/passwd", "page/main.js", "/page/languages"})
        EXPECT_EQ(page->find(path), nullptr) << path;
}

TEST(PageFiles, LinksHiddenFilesAndStrangeNamesArePassedOver) {
    ScratchFolder folder;
    with_page(folder);
    std::filesystem::create_symlink("/etc/passwd", folder.file("secret.txt"));
    std::filesystem::create_directory_symlink("/etc", folder.file("etc"));
    std::filesystem::create_directories(folder.file("languages/deeper"));
    write_bytes(folder.file("languages/deeper/far.js"), "far");
    write_bytes(folder.file(".hidden.js"), "hidden");
    write_bytes(folder.file("two words.js"), "words");
    write_bytes(folder.file("program.so"), "program");
    const auto page = PageFiles::read(folder.path());
    ASSERT_TRUE(page) << describe(page.error());
    EXPECT_EQ(page->count(), 3U);
}

TEST(PageFiles, AFolderWithoutAPageSaysWhatIsMissing) {
    ScratchFolder folder;
    const auto empty = PageFiles::read(folder.path());
    ASSERT_FALSE(empty);
    EXPECT_EQ(empty.error().fault, Fault::not_found);
    EXPECT_NE(describe(empty.error()).find("index.html"), std::string::npos);
    const auto missing = PageFiles::read(folder.file("nowhere"));
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().fault, Fault::io);
}

TEST(PageFiles, MoreThanAPageHasIsRefused) {
    ScratchFolder folder;
    with_page(folder);
    write_bytes(folder.file("huge.txt"), std::string(PageFiles::most_bytes + 1, 'x'));
    const auto page = PageFiles::read(folder.path());
    ASSERT_FALSE(page);
    EXPECT_EQ(page.error().fault, Fault::bad_configuration);
}

TEST(PageFiles, OtherBytesHaveAnotherTag) {
    ScratchFolder folder;
    const auto before = PageFiles::read(with_page(folder).path());
    write_bytes(folder.file("main.js"), "export { };");
    const auto after = PageFiles::read(folder.path());
    ASSERT_TRUE(before && after);
    EXPECT_NE(before->find("/page/main.js")->etag, after->find("/page/main.js")->etag);
    EXPECT_EQ(before->find("/")->etag, after->find("/")->etag);
}

TEST(PageFiles, ATagIsFoundInAListAndWeakly) {
    EXPECT_TRUE(names_etag("\"a\"", "\"a\""));
    EXPECT_TRUE(names_etag("\"b\", W/\"a\"", "\"a\""));
    EXPECT_TRUE(names_etag(" * ", "\"a\""));
    EXPECT_FALSE(names_etag("", "\"a\""));
    EXPECT_FALSE(names_etag("\"b\",,", "\"a\""));
    EXPECT_FALSE(names_etag("a", "\"a\""));
}

TEST(PageFiles, TheStatedFolderCountsElseTheInstalledOne) {
    ::setenv("AXISCAL_PAGE_PATH", "/srv/page", 1);
    EXPECT_EQ(page_folder(), "/srv/page");
    ::unsetenv("AXISCAL_PAGE_PATH");
    EXPECT_TRUE(page_folder().ends_with("/share/axiscal/page")) << page_folder();
}

TEST(HttpPage, AFileComesWithAPolicyThatLoadsNothingFromElsewhere) {
    ScratchFolder folder;
    const auto page = PageFiles::read(with_page(folder).path());
    const HttpResponse response = answer_page(asked("/"), *page, "/");
    EXPECT_EQ(response.result(), http::status::ok);
    EXPECT_EQ(response.body(), "<!doctype html>");
    EXPECT_EQ(field_of(response, "Cache-Control"), "no-cache");
    EXPECT_EQ(field_of(response, "X-Frame-Options"), "DENY");
    EXPECT_EQ(field_of(response, "X-Content-Type-Options"), "nosniff");
    const std::string policy = field_of(response, "Content-Security-Policy");
    EXPECT_TRUE(policy.starts_with("default-src 'none'; ")) << policy;
    for (const char* loose : {"unsafe", "*", "http", "blob"})
        EXPECT_EQ(policy.find(loose), std::string::npos) << policy;
}

TEST(HttpPage, WhoHasTheFileGetsNoBytes) {
    ScratchFolder folder;
    const auto page = PageFiles::read(with_page(folder).path());
    HttpRequest request = asked("/page/main.js");
    request.set(http::field::if_none_match, page->find("/page/main.js")->etag);
    const HttpResponse response = answer_page(request, *page, "/page/main.js");
    EXPECT_EQ(response.result(), http::status::not_modified);
    EXPECT_TRUE(response.body().empty());
    EXPECT_FALSE(field_of(response, "ETag").empty());
}

/// 259 times the letter a, and what gzip makes of it: one letter, and the same 258 times more.
const std::string long_text(259, 'a');
constexpr std::array<unsigned char, 22> packed_bytes{
    0x1f, 0x8b, 0x08, 0,    0, 0, 0, 0, 2, 3, // the head: no time, no name
    0x4b, 0x1c, 0x05, 0,                      // RFC 1951
    0x56, 0xfa, 0xc2, 0x34, 3, 1, 0, 0};      // CRC-32, and 259
const std::string packed_text{packed_bytes.begin(), packed_bytes.end()};

ScratchFolder& with_packed(ScratchFolder& folder, const std::string& text = long_text) {
    with_page(folder);
    write_bytes(folder.file("long.js"), text);
    write_bytes(folder.file("long.js.gz"), packed_text);
    return folder;
}

/// What a page of `folder` answers to who asks for long.js and says this of himself.
HttpResponse
long_file(const ScratchFolder& folder, const std::string& accepts, const std::string& has = "") {
    const auto page = PageFiles::read(folder.path());
    HttpRequest request = asked("/page/long.js");
    if (!accepts.empty()) request.set(http::field::accept_encoding, accepts);
    if (!has.empty()) request.set(http::field::if_none_match, has);
    return answer_page(request, *page, "/page/long.js");
}

TEST(PageFiles, ThePackedFormIsTakenFromBesideTheFile) {
    ScratchFolder folder;
    const auto page = PageFiles::read(with_packed(folder).path());
    ASSERT_TRUE(page) << describe(page.error());
    const PageFile& file = *page->find("/page/long.js");
    EXPECT_EQ(file.bytes(), long_text);
    EXPECT_EQ(file.packed, packed_text);
    EXPECT_TRUE(file.plain.empty()); // not held twice
    EXPECT_NE(file.packed_etag, file.etag);
    EXPECT_TRUE(page->find("/page/main.js")->packed.empty());
}

TEST(PageFiles, ThePackedFormHasNoNameOfItsOwn) {
    ScratchFolder folder;
    with_packed(folder);
    write_bytes(folder.file("gone.js.gz"), packed_text);
    const auto page = PageFiles::read(folder.path());
    ASSERT_TRUE(page);
    EXPECT_EQ(page->count(), 4U);
    for (const char* path : {"/page/long.js.gz", "/page/gone.js.gz", "/page/gone.js"})
        EXPECT_EQ(page->find(path), nullptr) << path;
}

TEST(PageFiles, WhatWasPackedOfOtherBytesIsPassedOver) {
    for (const std::string& text : {std::string(259, 'b'), std::string(258, 'a'), long_text + "a",
                                    std::string{"a"}, std::string{}}) {
        ScratchFolder folder;
        const auto page = PageFiles::read(with_packed(folder, text).path());
        ASSERT_TRUE(page) << describe(page.error());
        EXPECT_EQ(page->find("/page/long.js")->bytes(), text);
        EXPECT_TRUE(page->find("/page/long.js")->packed.empty()) << text;
    }
}

TEST(PageFiles, WhatIsNoPackedFormIsPassedOver) {
    std::string other_way = packed_text, named = packed_text, damaged = packed_text;
    other_way[2] = '\x07'; // no deflate
    named[3] = '\x08';     // a name follows the head
    damaged[10] = '\x4c';  // another letter, under the checksum of this one
    for (const std::string& packed :
         {std::string{}, packed_text.substr(0, 21), packed_text + "x", packed_text.substr(4),
          other_way, named, damaged, long_text}) {
        ScratchFolder folder;
        with_packed(folder);
        write_bytes(folder.file("long.js.gz"), packed);
        const auto page = PageFiles::read(folder.path());
        ASSERT_TRUE(page) << describe(page.error());
        EXPECT_TRUE(page->find("/page/long.js")->packed.empty()) << packed;
    }
}

TEST(PageFiles, AFolderOrALinkIsNoPackedForm) {
    ScratchFolder folder;
    with_packed(folder);
    std::filesystem::rename(folder.file("long.js.gz"), folder.file("elsewhere"));
    std::filesystem::create_symlink(folder.file("elsewhere"), folder.file("long.js.gz"));
    std::filesystem::create_directory(folder.file("main.js.gz"));
    const auto page = PageFiles::read(folder.path());
    ASSERT_TRUE(page) << describe(page.error());
    EXPECT_TRUE(page->find("/page/long.js")->packed.empty());
    EXPECT_TRUE(page->find("/page/main.js")->packed.empty());
}

TEST(HttpPage, WhoTakesGzipGetsThePackedForm) {
    ScratchFolder folder;
    with_packed(folder);
    const HttpResponse response = long_file(folder, "gzip, deflate, br, zstd");
    EXPECT_EQ(response.result(), http::status::ok);
    EXPECT_EQ(response.body(), packed_text);
    EXPECT_EQ(field_of(response, "Content-Encoding"), "gzip");
    EXPECT_EQ(field_of(response, "Content-Type"), "text/javascript; charset=utf-8");
    EXPECT_EQ(field_of(response, "Content-Length"), "22");
    EXPECT_EQ(field_of(response, "Vary"), "Accept-Encoding");
    EXPECT_EQ(field_of(response, "X-Content-Type-Options"), "nosniff");
}

TEST(HttpPage, WhoDoesNotTakeItGetsTheFileItself) {
    ScratchFolder folder;
    with_packed(folder);
    for (const char* accepts : {"", "identity", "br", "gzip;q=0", "*;q=0", "gzip;q=0, *;q=1"}) {
        const HttpResponse response = long_file(folder, accepts);
        EXPECT_EQ(response.body(), long_text) << accepts;
        EXPECT_EQ(field_of(response, "Content-Encoding"), "") << accepts;
        EXPECT_EQ(field_of(response, "Content-Length"), "259") << accepts;
        EXPECT_EQ(field_of(response, "Vary"), "Accept-Encoding") << accepts;
    }
}

TEST(HttpPage, LinesOfAcceptEncodingAreOneList) {
    ScratchFolder folder;
    const auto page = PageFiles::read(with_packed(folder).path());
    HttpRequest request = asked("/page/long.js");
    request.insert(http::field::accept_encoding, "br");
    request.insert(http::field::accept_encoding, "gzip");
    EXPECT_EQ(answer_page(request, *page, "/page/long.js").body(), packed_text);
    request.insert(http::field::accept_encoding, "gzip;q=0");
    EXPECT_EQ(answer_page(request, *page, "/page/long.js").body(), long_text);
}

TEST(HttpPage, EachFormIsUnchangedByItsOwnTagAlone) {
    ScratchFolder folder;
    with_packed(folder);
    const std::string plain = field_of(long_file(folder, ""), "ETag");
    const std::string packed = field_of(long_file(folder, "gzip"), "ETag");
    EXPECT_NE(plain, packed);
    for (const auto& [accepts, own, other] : {std::array{std::string{}, plain, packed},
                                              std::array{std::string{"gzip"}, packed, plain}}) {
        const HttpResponse kept = long_file(folder, accepts, own);
        EXPECT_EQ(kept.result(), http::status::not_modified);
        EXPECT_TRUE(kept.body().empty());
        EXPECT_EQ(field_of(kept, "ETag"), own);
        EXPECT_EQ(field_of(kept, "Vary"), "Accept-Encoding");
        EXPECT_EQ(field_of(kept, "Content-Encoding"), "");
        EXPECT_EQ(long_file(folder, accepts, other).result(), http::status::ok);
        EXPECT_EQ(long_file(folder, accepts, other + ", W/" + own).result(),
                  http::status::not_modified);
    }
}

TEST(HttpPage, AFileThatWasNotPackedIsSentAsItIs) {
    ScratchFolder folder;
    const auto page = PageFiles::read(with_packed(folder).path());
    HttpRequest request = asked("/page/main.js");
    request.set(http::field::accept_encoding, "gzip");
    const HttpResponse response = answer_page(request, *page, "/page/main.js");
    EXPECT_EQ(response.body(), "export {};");
    EXPECT_EQ(field_of(response, "Content-Encoding"), "");
    EXPECT_EQ(field_of(response, "Vary"), "Accept-Encoding");
}

TEST(HttpPage, AMissingFileAndAMissingPageSayWhichOfThemItIs) {
    ScratchFolder folder;
    const auto page = PageFiles::read(with_page(folder).path());
    const HttpResponse file = answer_page(asked("/page/x.js"), *page, "/page/x.js");
    EXPECT_EQ(file.result(), http::status::not_found);
    EXPECT_NE(file.body().find("no file of this name"), std::string::npos);
    const HttpResponse none = answer_page(asked("/"), PageFiles{}, "/");
    EXPECT_EQ(none.result(), http::status::not_found);
    EXPECT_NE(none.body().find("not installed"), std::string::npos);
}

TEST(HttpPage, OnlyTheRootAndWhatStandsBelowPageIsThePages) {
    EXPECT_TRUE(is_page_path("/"));
    EXPECT_TRUE(is_page_path("/page/main.js"));
    for (const char* other : {"", "/v1/status", "/metrics", "/pages/x", "/page"})
        EXPECT_FALSE(is_page_path(other)) << other;
}

TEST(PageFiles, TheShippedPageIsReadAndItsFirstScreenIsSmall) {
    const auto page = PageFiles::read(test::source_dir() + "/acquisition/console/page");
    ASSERT_TRUE(page) << describe(page.error());
    EXPECT_NE(page->find("/page/main.js"), nullptr);
    EXPECT_NE(page->find("/page/style.css"), nullptr);
    for (const char* language : {"en", "de", "ru", "zh"})
        EXPECT_NE(page->find("/page/languages/" + std::string{language} + ".json"), nullptr);
}

} // namespace
} // namespace axiscal::page_files_test
