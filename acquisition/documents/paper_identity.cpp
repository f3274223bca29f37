#include "acquisition/documents/paper_identity.hpp"

#include "acquisition/documents/record_json.hpp"
#include "acquisition/runfile/certificate_numbers.hpp"

#include <algorithm>
#include <optional>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

std::string text_at(const Json& object, const char* key) {
    return object.contains(key) && object[key].is_string() ? object[key].get<std::string>()
                                                           : std::string{};
}

/// What the newest result says; nothing without one.
Result<std::optional<PaperIdentity>> newest_identity(const std::string& run_file) {
    const auto stored = read_stored_result(run_file);
    if (!stored && stored.error().fault == Fault::not_found) return std::optional<PaperIdentity>{};
    if (!stored) return tl::unexpected<Error>(stored.error());
    const Json document = Json::parse(stored->document, nullptr, false);
    PaperIdentity identity;
    if (!document.is_object() || !document.contains("certificate")) return std::optional{identity};
    const Json& certificate = document["certificate"];
    identity.number = text_at(certificate, "number");
    identity.replaces = text_at(certificate, "replaces");
    if (certificate.contains("closing") && certificate["closing"].is_number_integer())
        identity.closing = certificate["closing"].get<int>();
    return std::optional{identity};
}

/// How people call it: its number, without one the name of its folder.
std::string name_for_people(const PaperIdentity& identity, const std::string& run_id) {
    if (!identity.number.empty()) return identity.number;
    RunSummary run;
    run.run_id = run_id;
    run.closings = identity.closing;
    return certificate_name(run);
}

} // namespace

PaperOfRun paper_of(const RunFileContents& contents) {
    return {contents.run.run_id, contents.run.statements.certificate_number,
            contents.revisions.closings, contents.results};
}

Result<PaperIdentity> identity_of(const std::string& run_file, const PaperOfRun& paper) {
    if (!paper.stored()) return PaperIdentity{"", "", paper.closings};
    AXISCAL_TRY(const auto stored, newest_identity(run_file));
    return stored.value_or(PaperIdentity{"", "", paper.closings});
}

Result<PaperIdentity> new_identity(const std::string& run_file,
                                   const PaperOfRun& paper,
                                   const std::string& state_directory,
                                   int year) {
    PaperIdentity identity;
    identity.closing = paper.closings;
    AXISCAL_TRY(const auto earlier, newest_identity(run_file));
    if (earlier) identity.replaces = name_for_people(*earlier, paper.run_id);
    const std::string& pattern = paper.number_pattern;
    if (pattern.empty() || state_directory.empty()) return identity;
    AXISCAL_TRY(
        identity.number,
        take_certificate_number(state_directory, {pattern, paper.run_id, identity.closing, year}));
    return identity;
}

Json identity_json(const PaperIdentity& identity) {
    return {{"number", stated_json(identity.number)},
            {"closing", identity.closing},
            {"replaces", stated_json(identity.replaces)}};
}

std::string amendment_remark(const PaperIdentity& identity) {
    return "This certificate replaces certificate " + identity.replaces + ".";
}

} // namespace axiscal
