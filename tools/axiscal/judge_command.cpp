// `axiscal judge`: a published report held against its own readings.
#include "config/json_text.hpp"
#include "tools/axiscal/case_text.hpp"
#include "tools/axiscal/complaint.hpp"
#include "tools/axiscal/exit_code.hpp"
#include "tools/axiscal/imports/judged_report.hpp"
#include "tools/axiscal/offline_commands.hpp"
#include "tools/axiscal/whole_file.hpp"

#include <iostream>
#include <utility>

namespace axiscal {
namespace {

Result<nlohmann::json> json_in(const std::string& path) {
    AXISCAL_TRY(const std::string bytes, whole_file(path));
    auto read = read_case_text(bytes);
    if (!read) {
        Error error = read.error();
        error.field = path + ", " + error.field;
        return tl::unexpected<Error>(std::move(error));
    }
    if (!read->repeated_keys.empty())
        return refuse(Fault::bad_case, path,
                      printable(read->repeated_keys.begin()->second) +
                          " stands twice in one object");
    return std::move(read->document);
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
