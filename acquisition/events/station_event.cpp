#include "acquisition/events/station_event.hpp"

#include "acquisition/runfile/digest.hpp"
#include "analysis/quantity/valid_text.hpp"
#include "config/json_text.hpp"

#include <nlohmann/json.hpp>

namespace axiscal {
namespace {

constexpr std::size_t longest_sentence = 1000; // bytes; in JSON six times that at most
constexpr std::size_t id_digits = 32;          // 128 bits

std::string cut(const std::string& sentence) {
    return valid_text(sentence.substr(0, longest_sentence)); // also of a sign that was cut in two
}

} // namespace

std::string name_of(StationEvent::About about) {
    return about == StationEvent::About::complete ? "complete" : "fault";
}

std::string event_id(const StationEvent& event) {
    const bool complete = event.about == StationEvent::About::complete;
    const std::string what = complete ? event.certificate : std::string{fault_name(event.fault)};
    const std::string all = name_of(event.about) + '\n' + event.run_id + '\n' + what;
    return "evt_" + sha256_hex(all).substr(0, id_digits);
}

std::string
event_body(const StationEvent& event, const std::string& station, std::int64_t dropped) {
    nlohmann::ordered_json body{{"id", event_id(event)},
                                {"when", event.when_utc},
                                {"kind", name_of(event.about)},
                                {"station", station},
                                {"run", event.run_id}};
    if (event.test) body["test"] = std::string{name_of(*event.test)};
    if (!event.certificate.empty()) body["certificate"] = event.certificate;
    if (!event.parameter.empty())
        body["verdict"] = {{"figure", event.parameter}, {"verdict", event.verdict}};
    if (event.fault != Fault::none) body["fault"] = std::string{fault_name(event.fault)};
    if (!event.sentence.empty()) body["sentence"] = cut(event.sentence);
    if (dropped > 0) body["dropped"] = dropped;
    return json_text(body);
}

} // namespace axiscal
