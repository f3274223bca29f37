#pragma once
// What the cells of a sheet refer to: where the sheet lies in its workbook, texts, formats. Pure.

#include "analysis/quantity/result.hpp"

#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// The XML of a part; `what` names it where it is damaged.
Result<pugi::xml_document> parsed_part(const std::string& xml, const std::string& what);

/// Without its prefix: writers differ in that.
std::string_view local_name(const char* name);
/// The first child, or attribute, of this local name; empty handle: none.
pugi::xml_node child_named(const pugi::xml_node& parent, std::string_view name);
std::string attribute_named(const pugi::xml_node& node, std::string_view name);

/// All <t> of a text, or of its runs; what it is read aloud as (<rPh>) is not of it.
std::string text_of_runs(const pugi::xml_node& text);

struct WorkbookParts {
    std::string sheet;              ///< its XML
    std::vector<std::string> texts; ///< the shared ones, by index
    std::vector<bool> dates;        ///< by style: whether it shows a number as a date or a time
};

/// @errors as sheet_text().
Result<WorkbookParts> workbook_parts(std::string_view zip, const std::string& sheet);

} // namespace axiscal
