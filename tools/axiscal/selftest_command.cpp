// `axiscal selftest`: prints what tools/axiscal/selftest measures.
#include "config/json_text.hpp"
#include "tools/axiscal/exit_code.hpp"
#include "tools/axiscal/offline_commands.hpp"
#include "tools/axiscal/selftest/selftest.hpp"

#include <nlohmann/json.hpp>

#include <iostream>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Delays& delays, const SelftestVerdict& verdict) {
    return {{"count", delays.count},   {"median_us", delays.median_us},
            {"p99_us", delays.p99_us}, {"worst_us", delays.worst_us},
            {"ok", verdict.ok},        {"means", verdict.sentence}};
}

Json json_of(const SerialPort& port, const SelftestVerdict& verdict) {
    return {{"path", port.path},
            {"latency_timer_ms", port.latency_timer_ms ? Json(*port.latency_timer_ms) : Json{}},
            {"ok", verdict.ok},
            {"means", verdict.sentence}};
}

void say(const char* what, const SelftestVerdict& verdict) {
    std::cout << what << (verdict.ok ? "" : "LOOK: ") << verdict.sentence << "\n";
}

Result<SelfTest> measure(const SelfTestRequest& request) {
    SelfTest test;
    test.folder = request.folder;
    AXISCAL_TRY(test.commit, measure_commit(request.folder, request.count));
    AXISCAL_TRY(test.timer, measure_timer(request.count));
    AXISCAL_TRY(test.serial, measure_serial(request.count));
    for (const std::string& path : request.ports)
        test.ports.push_back(look_at_port(path));
    return test;
}

} // namespace

int command_selftest(const SelfTestRequest& request, bool json) {
    const auto test = measure(request);
    if (!test) {
        std::cerr << describe(test.error()) << "\n";
        return exit_failed;
    }
    if (json) {
        Json ports = Json::array();
        for (const SerialPort& port : test->ports)
            ports.push_back(json_of(port, judge_port(port)));
        std::cout << json_text(Json{{"folder", test->folder},
                                    {"commit", json_of(test->commit, judge_commit(test->commit))},
                                    {"timer", json_of(test->timer, judge_timer(test->timer))},
                                    {"serial", json_of(test->serial, judge_serial(test->serial))},
                                    {"ports", std::move(ports)}})
                  << "\n";
        return exit_ok;
    }
    std::cout << test->commit.count << " trials each, run files in " << test->folder << "\n";
    say("disk    ", judge_commit(test->commit));
    say("timer   ", judge_timer(test->timer));
    say("serial  ", judge_serial(test->serial));
    for (const SerialPort& port : test->ports)
        say("port    ", judge_port(port));
    return exit_ok;
}

} // namespace axiscal
