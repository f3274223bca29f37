// `axiscal judge`: a published report held against its own readings.
#include "config/json_text.hpp"
#include "tools/axiscal/complaint.hpp"
#include "tools/axiscal/exit_code.hpp"
#include "tools/axiscal/imports/judged_report.hpp"
#include "tools/axiscal/offline_commands.hpp"

#include <filesystem>
#include <fstream>
#include <iostream>

namespace axiscal {
namespace {

Result<nlohmann::json> json_in(const std::string& path) {
    std::ifstream file{path, std::ios::binary};
    if (!file || std::filesystem::is_directory(path)) return fail(Fault::io, "cannot read " + path);
    auto parsed = nlohmann::json::parse(file, nullptr, false);
    if (parsed.is_discarded()) return fail(Fault::bad_case, path + " is no JSON");
    return parsed;
}

} // namespace

int command_judge(const JudgeOrder& order) {
    const auto document = json_in(order.document);
    if (!document) return complain(document.error());
    const auto report = json_in(order.report);
    if (!report) return complain(report.error());
    const auto answer = judge_report(*document, *report);
    if (!answer) return complain(answer.error());
    std::cout << json_text(*answer) << "\n" << std::flush;
    return answer->at("findings").empty() ? exit_ok : exit_changed;
}

} // namespace axiscal
