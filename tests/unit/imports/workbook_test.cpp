#include "tools/axiscal/imports/workbook.hpp"

#include "tools/axiscal/imports/import_file.hpp"
#include "tools/axiscal/imports/zip_part.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace axiscal::workbook_test {
namespace {

using Parts = std::map<std::string, std::string>;

std::string zipped(const Parts& parts) {
    std::size_t room = 1 << 20, used = 0;
    for (const auto& [name, bytes] : parts)
        room += bytes.size();
    std::vector<char> memory(room);
    archive* const out = archive_write_new();
    archive_write_set_format_zip(out);
    EXPECT_EQ(archive_write_open_memory(out, memory.data(), memory.size(), &used), ARCHIVE_OK);
    for (const auto& [name, bytes] : parts) {
        archive_entry* const entry = archive_entry_new();
        archive_entry_set_pathname(entry, name.c_str());
        archive_entry_set_filetype(entry, AE_IFREG);
        archive_entry_set_perm(entry, 0644);
        archive_entry_set_size(entry, static_cast<la_int64_t>(bytes.size()));
        EXPECT_EQ(archive_write_header(out, entry), ARCHIVE_OK);
        EXPECT_EQ(archive_write_data(out, bytes.data(), bytes.size()),
                  static_cast<la_ssize_t>(bytes.size()));
        archive_entry_free(entry);
    }
    archive_write_free(out);
    return {memory.data(), used};
}

constexpr const char* relation =
    "http://schemas.openxmlformats.org/officeDocument/2006/relationships/";

std::string relations(const std::vector<std::array<std::string, 3>>& of) {
    std::string xml = "<Relationships>";
    for (const auto& [id, type, target] : of)
        xml += "<Relationship Id=\"" + id + "\" Type=\"" + relation + type + "\" Target=\"" +
               target + "\"/>";
    return xml + "</Relationships>";
}

/// A hidden sheet, then one with these rows, then another.
Parts workbook_of(const std::string& rows, const std::string& behind = {}) {
    const auto sheet = [](const std::string& inside, const std::string& after) {
        return "<?xml version=\"1.0\" encoding=\"UTF-8\"?><worksheet><sheetData>" + inside +
               "</sheetData>" + after + "</worksheet>";
    };
    return {
        {"_rels/.rels", relations({{"a", "officeDocument", "xl/workbook.xml"}})},
        {"xl/workbook.xml",
         "<workbook xmlns:r=\"x\"><sheets><sheet name=\"old\" state=\"hidden\" r:id=\"r1\"/>"
         "<sheet name=\"Messung\" r:id=\"r2\"/><sheet name=\"two\" r:id=\"r3\"/></sheets>"
         "</workbook>"},
        {"xl/_rels/workbook.xml.rels", relations({{"r1", "worksheet", "worksheets/s1.xml"},
                                                  {"r2", "worksheet", "worksheets/s2.xml"},
                                                  {"r3", "worksheet", "/xl/worksheets/s3.xml"},
                                                  {"r4", "sharedStrings", "sharedStrings.xml"},
                                                  {"r5", "styles", "styles.xml"}})},
        {"xl/sharedStrings.xml",
         "<sst><si><t>Soll</t></si><si><r><t>Feh</t></r><r><t>ler</t></r><rPh><t>x</t></rPh></si>"
         "</sst>"},
        {"xl/styles.xml",
         "<styleSheet><numFmts><numFmt numFmtId=\"170\" formatCode=\"0.00\\ &quot;mm&quot;\"/>"
         "<numFmt numFmtId=\"171\" formatCode=\"dd/mm/yy\"/></numFmts><cellXfs>"
         "<xf numFmtId=\"0\"/><xf numFmtId=\"170\"/><xf numFmtId=\"171\"/><xf numFmtId=\"14\"/>"
         "</cellXfs></styleSheet>"},
        {"xl/worksheets/s1.xml", sheet("<row r=\"1\"><c><v>1</v></c></row>", "")},
        {"xl/worksheets/s2.xml", sheet(rows, behind)},
        {"xl/worksheets/s3.xml", sheet("<row><c><v>3</v></c><c t=\"b\"><v>1</v></c></row>", "")},
    };
}

std::string text_of(const Parts& parts, const std::string& name = {}) {
    const auto text = sheet_text(zipped(parts), name);
    EXPECT_TRUE(text) << (text ? "" : describe(text.error()));
    return text.value_or("");
}

std::string refusal_of(const std::string& bytes, const std::string& name = {}) {
    const auto text = sheet_text(bytes, name);
    EXPECT_FALSE(text);
    return text ? std::string{} : describe(text.error());
}

void expect_words(const std::string& text, const std::string& words) {
    EXPECT_NE(text.find(words), std::string::npos) << text;
}

TEST(Workbook, GivesALineForEachRowOfTheFirstSheetThatIsSeen) {
    EXPECT_EQ(
        text_of(workbook_of("<row r=\"2\"><c r=\"B2\" t=\"s\"><v>0</v></c><c r=\"C2\" t=\"s\">"
                            "<v>1</v></c></row><row r=\"4\"><c r=\"B4\"><v>47.5</v></c>"
                            "<c r=\"C4\" t=\"inlineStr\"><is><t>a;\"b\"</t></is></c></row>")),
        "\t\t\n\tSoll\tFehler\n\t\t\n\t47.5\t\"a;\"\"b\"\"\"\n");
    EXPECT_EQ(text_of(workbook_of(""), "two"), "3\tTRUE\n");
    EXPECT_EQ(text_of(workbook_of(""), "old"), "1\n") << "hidden, but named";
}

TEST(Workbook, TakesTheValueThatAFormulaKeptAndNoDateForANumber) {
    EXPECT_EQ(
        text_of(workbook_of("<row r=\"1\"><c r=\"A1\"><f>1+1</f><v>2</v></c><c r=\"B1\">"
                            "<f>A1</f></c><c r=\"C1\" s=\"1\"><v>5</v></c><c r=\"D1\" s=\"2\">"
                            "<v>46143</v></c><c r=\"E1\" s=\"3\"><v>1</v></c></row>")),
        "2\tformula without a value\t5\tdate 46143\tdate 1\n");
}

TEST(Workbook, ShowsTheSameTargetWhetherItWasTypedOrComputed) {
    EXPECT_EQ(text_of(workbook_of("<row><c><f>0.1+0.2</f><v>0.30000000000000004</v></c>"
                                  "<c><v>0.3</v></c><c><v>-1.2300000000000002E-3</v></c>"
                                  "<c><v>123456.789</v></c></row>")),
              "0.3\t0.3\t-0.00123\t123456.789\n");
}

TEST(Workbook, KeepsABlankThatIsARunOfItsOwn) {
    EXPECT_EQ(text_of(workbook_of("<row><c t=\"inlineStr\"><is><r><t>Pos</t></r><r><t "
                                  "xml:space=\"preserve\"> </t></r><r><t>soll</t></r></is></c>"
                                  "<c r=\"XFD1\" t=\"inlineStr\"><is><t> </t></is></c></row>")),
              "Pos soll\n");
}

TEST(Workbook, FillsMergedCellsAndPassesOverEmptyOnesFarOut) {
    EXPECT_EQ(text_of(workbook_of("<row r=\"1\"><c r=\"A1\"><v>7</v></c><c r=\"B1\"><v>1</v></c>"
                                  "<c r=\"XFD1\" s=\"1\"/></row><row r=\"2\"><c r=\"A2\"/>"
                                  "<c r=\"B2\"><v>2</v></c></row>",
                                  "<mergeCells><mergeCell ref=\"A1:A2\"/></mergeCells>")),
              "7\t1\n7\t2\n");
}

TEST(Workbook, WritesNumbersWithCommasWhereTextsCertainlyHaveThem) {
    const auto row = [](const std::string& text) {
        return workbook_of("<row><c><v>47.5</v></c><c t=\"inlineStr\"><is><t>" + text +
                           "</t></is></c></row>");
    };
    EXPECT_EQ(text_of(row("2,5")), "47,5\t2,5\n");
    EXPECT_EQ(text_of(row("-0,123")), "47,5\t-0,123\n");
    EXPECT_EQ(text_of(row("1,234")), "47.5\t1,234\n") << "may part thousands";
    EXPECT_EQ(text_of(row("a,5")), "47.5\ta,5\n");
}

TEST(Workbook, ThatCannotBeReadIsRefusedWithTheWayOut) {
    const std::string ole = "\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1 rest";
    expect_words(refusal_of(ole), "save it as .xlsx or CSV");
    std::string encrypted = ole;
    for (const char letter : std::string{"EncryptedPackage"})
        encrypted += std::string{letter} + '\0';
    expect_words(refusal_of(encrypted), "without a password");
    const std::string whole = zipped(workbook_of("<row><c><v>1</v></c></row>"));
    expect_words(refusal_of(whole, "three"), "no sheet \"three\". It has: old, Messung, two");
    expect_words(refusal_of(whole.substr(0, whole.size() / 2)), "damaged ZIP");
    expect_words(refusal_of(zipped({{"mimetype", "x"}})), "no .xlsx workbook");
    expect_words(refusal_of(zipped(workbook_of(""))), "no cell with a value");
    expect_words(refusal_of(zipped(workbook_of("<row><c><v>1</c>"))), "no whole XML");
    expect_words(refusal_of(zipped(workbook_of("<row r=\"1\"><c r=\"A1\"><v>1</v></c></row>"
                                               "<row r=\"1048576\"><c r=\"XFD1048576\"><v>1</v>"
                                               "</c></row>"))),
                 "far from each other");
}

TEST(Workbook, ThatUnpacksWithoutEndIsRefused) {
    Parts parts = workbook_of("");
    parts["xl/worksheets/s2.xml"] = std::string(largest_part_bytes + 1, ' ');
    expect_words(refusal_of(zipped(parts)), "unpacks to more than 32 MiB");
}

/// Each part is small: what a cell refers to is not.
TEST(Workbook, WhoseCellsRepeatALongTextIsRefused) {
    std::string rows;
    for (int i = 0; i < 100; ++i)
        rows += "<row><c t=\"s\"><v>0</v></c></row>";
    Parts parts = workbook_of(rows);
    parts["xl/sharedStrings.xml"] =
        "<sst><si><t>" + std::string(std::size_t{1} << 20, 'x') + "</t></si></sst>";
    expect_words(refusal_of(zipped(parts)), "more than 64 MiB of text");
    const std::string once = "<row><c t=\"inlineStr\"><is><t>" +
                             std::string(std::size_t{1} << 20, 'x') +
                             "</t></is></c></row><row r=\"100\"><c r=\"B100\"><v>1</v></c></row>";
    expect_words(refusal_of(zipped(
                     workbook_of(once, "<mergeCells><mergeCell ref=\"A1:A100\"/></mergeCells>"))),
                 "more than 64 MiB of text");
}

TEST(Workbook, IsATableByTheSameMapAsText) {
    const auto map = import_map("kind = \"table\"\nsheet = \"Messung\"\nreadings = \"deviations\"\n"
                                "unit = \"um\"\ntarget_unit = \"mm\"\n[columns]\n"
                                "target = \"Soll\"\nreading = \"Fehler\"\n",
                                "map.toml");
    ASSERT_TRUE(map) << describe(map.error());
    std::string rows = "<row r=\"1\"><c r=\"A1\" t=\"s\"><v>0</v></c><c r=\"B1\" t=\"s\"><v>1</v>"
                       "</c></row>";
    for (const auto& [target, reading] :
         {std::array{"0", "0.5"}, std::array{"10", "1.5"}, std::array{"20", "2.5E0"},
          std::array{"20", "2"}, std::array{"10", "1"}, std::array{"0", "-1"}})
        rows += std::string{"<row><c><v>"} + target + "</v></c><c><v>" + reading + "</v></c></row>";
    const auto file = import_file(zipped(workbook_of(rows)), *map);
    ASSERT_TRUE(file) << describe(file.error());
    EXPECT_EQ(file->document.at("forward"), nlohmann::json({{0.5}, {1.5}, {2.5}}));
    EXPECT_EQ(file->document.at("backward"), nlohmann::json({{-1.0}, {1.0}, {2.0}}));
    std::string date = rows;
    date.replace(date.find("<c><v>1.5"), 9, "<c s=\"3\"><v>46143");
    const auto refused = import_file(zipped(workbook_of(date)), *map);
    ASSERT_FALSE(refused);
    expect_words(describe(refused.error()), "table line 3, reading");
    expect_words(describe(refused.error()), "'date 46143' is not a number");
}

} // namespace
} // namespace axiscal::workbook_test
