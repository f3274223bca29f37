#pragma once
// Asks the case door and looks at the answer.

#include "tools/axiscal/analyze_case.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

namespace axiscal::test {

inline nlohmann::json answer_to(const nlohmann::json& request) {
    const CaseAnswer answer = analyze_cases(request.dump());
    EXPECT_EQ(answer.exit_code, 0) << answer.error_line;
    if (answer.exit_code != 0) return {};
    auto document = nlohmann::json::parse(answer.output);
    EXPECT_EQ(document.at("format"), "axiscal.result/1");
    EXPECT_TRUE(answer.output.starts_with("{\n  \"format\"")) << "the format comes first";
    return document;
}

/// The refused field; "accepted" for an answer.
inline std::string refused_field(const nlohmann::json& request) {
    const CaseAnswer answer = analyze_cases(request.dump());
    if (answer.exit_code == 0) return "accepted";
    EXPECT_EQ(answer.exit_code, 3);
    EXPECT_EQ(answer.error_line.find('\n'), std::string::npos);
    const std::string line = answer.error_line.substr(std::string{"refused: "}.size());
    return line.substr(0, line.find(": "));
}

inline nlohmann::json
with(nlohmann::json request, const std::string& pointer, const nlohmann::json& value) {
    request[nlohmann::json::json_pointer{pointer}] = value;
    return request;
}

inline nlohmann::json without(nlohmann::json request, const std::string& key) {
    request.erase(key);
    return request;
}

/// Every number that the case holds is replaced, one at a time, by numbers that nobody means: each
/// case is answered or refused, and no answer holds NaN or infinity (dump() writes them as null).
inline void expect_numbers_in_numbers_out(const nlohmann::json& request) {
    const std::vector<double> odd{0,    -0.0,  1,    -1,    1e-300, -1e-300, 1e-13,
                                  1e12, -1e12, 1e13, 1e300, -1e300, 0.5,     2};
    const auto flat = request.flatten();
    for (const auto& [pointer, value] : flat.items()) {
        if (!value.is_number()) continue;
        for (const double number : odd) {
            const CaseAnswer answer = analyze_cases(with(request, pointer, number).dump());
            ASSERT_TRUE(answer.exit_code == 0 || answer.exit_code == 3);
            ASSERT_EQ(answer.output.find("null"), std::string::npos) << pointer << number;
        }
    }
}

} // namespace axiscal::test
