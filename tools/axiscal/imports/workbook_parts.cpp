#include "tools/axiscal/imports/workbook_parts.hpp"

#include "analysis/quantity/valid_text.hpp"
#include "tools/axiscal/imports/zip_part.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace axiscal {
namespace {

tl::unexpected<Error> refuse_no_workbook(const std::string& why) {
    return refuse(Fault::bad_case, "file",
                  "is a ZIP, but no .xlsx workbook (" + why + "): save it as .xlsx or CSV");
}

Result<pugi::xml_document> part_in(std::string_view zip, const std::string& name) {
    AXISCAL_TRY(const auto xml, zip_part(zip, name));
    if (!xml) return refuse_no_workbook("it has no " + valid_text(name));
    return parsed_part(*xml, name);
}

/// Target of each relation, by its id.
struct Relation {
    std::string type, part;
};
using Relations = std::map<std::string, Relation>;

std::string folder_in_zip(const std::string& part) {
    const auto slash = part.rfind('/');
    return slash == std::string::npos ? std::string{} : part.substr(0, slash + 1);
}

/// "xl/_rels/workbook.xml.rels" of "xl/workbook.xml", "_rels/.rels" of the workbook itself.
Result<Relations> relations_of(std::string_view zip, const std::string& part) {
    const std::string folder = folder_in_zip(part);
    AXISCAL_TRY(const auto document,
                part_in(zip, folder + "_rels/" + part.substr(folder.size()) + ".rels"));
    Relations relations;
    for (const pugi::xml_node& one : document.document_element().children()) {
        std::string type = attribute_named(one, "Type"), target = attribute_named(one, "Target");
        type.erase(0, type.rfind('/') == std::string::npos ? 0 : type.rfind('/') + 1);
        target = target.starts_with('/') ? target.substr(1) : folder + target;
        relations[attribute_named(one, "Id")] = {std::move(type), std::move(target)};
    }
    return relations;
}

std::string part_of_type(const Relations& relations, std::string_view type) {
    for (const auto& [id, relation] : relations)
        if (relation.type == type) return relation.part;
    return {};
}

/// Where the sheet of this name lies, or the first one that is seen.
Result<std::string> sheet_part(const pugi::xml_document& workbook,
                               const Relations& relations,
                               const std::string& wanted) {
    std::string names;
    for (const pugi::xml_node& one :
         child_named(workbook.document_element(), "sheets").children()) {
        const auto relation = relations.find(attribute_named(one, "id"));
        if (relation == relations.end() || relation->second.type != "worksheet") continue; // chart
        const std::string name = attribute_named(one, "name"),
                          state = attribute_named(one, "state");
        const bool seen = state.empty() || state == "visible";
        if (wanted.empty() ? seen : name == wanted) return relation->second.part;
        if (names.size() < 200) names += (names.empty() ? "" : ", ") + valid_text(name);
    }
    return refuse(Fault::bad_case, "sheet",
                  wanted.empty()
                      ? "the workbook has no sheet that is not hidden: name one (sheet)"
                      : "the workbook has no sheet \"" + wanted + "\". It has: " + names);
}

std::vector<std::string> shared_texts(const pugi::xml_document& document) {
    std::vector<std::string> texts;
    for (const pugi::xml_node& text : document.document_element().children())
        if (local_name(text.name()) == "si") texts.push_back(text_of_runs(text));
    return texts;
}

/// Letters of date or time outside of quotes, brackets and what is escaped.
bool is_date_code(std::string_view code) {
    for (std::size_t i = 0; i < code.size(); ++i) {
        const char letter = code[i];
        if (letter == '"' || letter == '[') {
            i = std::min(code.find(letter == '"' ? '"' : ']', i + 1), code.size());
        } else if (letter == '\\' || letter == '_' || letter == '*') {
            ++i;
        } else if (std::string_view{"yYmMdDhHsS"}.find(letter) != std::string_view::npos) {
            return true;
        }
    }
    return false;
}

/// Of the numbers that every workbook knows (ECMA-376-1, 18.8.30), also those of East Asia.
bool is_known_date(int format) {
    return (format >= 14 && format <= 22) || (format >= 27 && format <= 36) ||
           (format >= 45 && format <= 47) || (format >= 50 && format <= 58);
}

std::vector<bool> dates_of_styles(const pugi::xml_document& document) {
    const pugi::xml_node styles = document.document_element();
    std::set<int> own;
    for (const pugi::xml_node& one : child_named(styles, "numFmts").children())
        if (is_date_code(attribute_named(one, "formatCode")))
            own.insert(one.attribute("numFmtId").as_int());
    std::vector<bool> dates;
    for (const pugi::xml_node& one : child_named(styles, "cellXfs").children()) {
        const int format = one.attribute("numFmtId").as_int();
        dates.push_back(is_known_date(format) || own.contains(format));
    }
    return dates;
}

/// Small workbooks have neither shared texts nor styles.
Result<pugi::xml_document>
part_if_any(std::string_view zip, const Relations& relations, std::string_view type) {
    const std::string part = part_of_type(relations, type);
    if (part.empty()) return pugi::xml_document{};
    return part_in(zip, part);
}

} // namespace

std::string_view local_name(const char* name) {
    const std::string_view whole{name};
    const auto colon = whole.find(':');
    return colon == std::string_view::npos ? whole : whole.substr(colon + 1);
}

pugi::xml_node child_named(const pugi::xml_node& parent, std::string_view name) {
    for (const pugi::xml_node& child : parent.children())
        if (local_name(child.name()) == name) return child;
    return {};
}

std::string attribute_named(const pugi::xml_node& node, std::string_view name) {
    for (const pugi::xml_attribute& attribute : node.attributes())
        if (local_name(attribute.name()) == name) return attribute.value();
    return {};
}

std::string text_of_runs(const pugi::xml_node& text) {
    std::string whole;
    for (const pugi::xml_node& part : text.children()) {
        if (local_name(part.name()) == "t") whole += part.text().get();
        if (local_name(part.name()) == "r") whole += child_named(part, "t").text().get();
    }
    return whole;
}

Result<pugi::xml_document> parsed_part(const std::string& xml, const std::string& what) {
    Result<pugi::xml_document> document;
    // A run may be one blank: "Pos", " ", "soll".
    constexpr unsigned how = pugi::parse_default | pugi::parse_ws_pcdata_single;
    if (!document->load_buffer(xml.data(), xml.size(), how))
        return refuse(Fault::bad_case, "file",
                      "is damaged: its part " + valid_text(what) +
                          " is no whole XML. Save the workbook again as .xlsx or CSV");
    return document;
}

Result<WorkbookParts> workbook_parts(std::string_view zip, const std::string& sheet) {
    AXISCAL_TRY(const Relations roots, relations_of(zip, {}));
    const std::string book = part_of_type(roots, "officeDocument");
    if (!book.ends_with(".xml"))
        return refuse_no_workbook(book.empty() ? "no part is its document" : "it is binary");
    AXISCAL_TRY(const auto workbook, part_in(zip, book));
    AXISCAL_TRY(const Relations relations, relations_of(zip, book));
    WorkbookParts parts;
    AXISCAL_TRY(const std::string place, sheet_part(workbook, relations, sheet));
    AXISCAL_TRY(auto xml, zip_part(zip, place));
    if (!xml) return refuse_no_workbook("its sheet is missing");
    parts.sheet = *std::move(xml);
    AXISCAL_TRY(const auto texts, part_if_any(zip, relations, "sharedStrings"));
    parts.texts = shared_texts(texts);
    AXISCAL_TRY(const auto styles, part_if_any(zip, relations, "styles"));
    parts.dates = dates_of_styles(styles);
    return parts;
}

} // namespace axiscal
