#include "tools/axiscal/conformance.hpp"

#include "config/json_text.hpp"
#include "config/version.hpp"
#include "tools/axiscal/analyze_case.hpp"
#include "tools/axiscal/conformance/foreign_program.hpp"
#include "tools/axiscal/conformance/kit.hpp"
#include "tools/axiscal/conformance/report.hpp"
#include "tools/axiscal/exit_code.hpp"

#include <cmath>
#include <iostream>

namespace axiscal {
namespace {

Result<std::string> answer_of(const ConformanceOrder& order, const std::string& text) {
    if (!order.command.empty())
        return ask_program(order.command, text,
                           std::chrono::milliseconds{std::llround(order.seconds * 1000)});
    CaseAnswer answer = analyze_cases(text);
    if (answer.exit_code != 0) return fail(Fault::refused, answer.error_line);
    return std::move(answer.output);
}

CaseVerdict verdict_of(const ConformanceOrder& order, const ConformanceCase& asked) {
    const auto answer = answer_of(order, json_text(asked.input) + "\n");
    return answer ? judge_answer(asked, *answer) : judge_silence(asked, answer.error().detail);
}

int tell_no_kit(const Error& error) {
    std::cerr << error.detail;
    if (error.cause) std::cerr << ": " << error.cause.message();
    std::cerr << "\n";
    return exit_failed;
}

} // namespace

int command_conformance(const ConformanceOrder& order, bool json) {
    const auto folder = find_conformance_folder(order.folder);
    if (!folder) return tell_no_kit(folder.error());
    const auto kit = read_kit(*folder, order.only);
    if (!kit) {
        tell_no_kit(kit.error());
        return kit.error().fault == Fault::not_found ? exit_usage : exit_failed;
    }
    for (const std::string& complaint : kit->complaints)
        std::cerr << complaint << "\n";
    if (!kit->complaints.empty()) return kit->unreadable ? exit_failed : exit_refused;
    std::vector<CaseVerdict> verdicts;
    for (const ConformanceCase& asked : kit->cases) {
        verdicts.push_back(verdict_of(order, asked));
        if (!json) std::cout << text_of_verdict(verdicts.back(), order.brief) << std::flush;
    }
    const Tally tally = tally_of(verdicts);
    const std::string program =
        order.command.empty() ? std::string{"axiscal "} + software_version() : order.command;
    std::cout << (json ? json_text(json_of_verdicts(verdicts, program), 2) + "\n"
                       : text_of_tally(tally));
    return tally.all_agree() ? exit_ok : exit_disagrees;
}

} // namespace axiscal
