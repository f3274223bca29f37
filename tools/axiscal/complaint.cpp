#include "tools/axiscal/complaint.hpp"

#include "config/json_text.hpp"
#include "tools/axiscal/exit_code.hpp"

#include <nlohmann/json.hpp>

#include <iostream>

namespace axiscal {

int complain(const Error& error) {
    std::cerr << describe(error) << "\n";
    return error.fault == Fault::io ? exit_failed : exit_refused;
}

int complain(const std::vector<Refusal>& refusals, bool json) {
    using Json = nlohmann::ordered_json;
    Json list = Json::array();
    for (const Refusal& refusal : refusals) {
        list.push_back({{"file", refusal.file},
                        {"line", refusal.line},
                        {"key", refusal.key},
                        {"reason", refusal.reason}});
        if (!json) std::cerr << refusal.describe() << "\n";
    }
    if (json) std::cout << json_text(Json{{"refusals", std::move(list)}}) << "\n";
    return exit_refused;
}

} // namespace axiscal
