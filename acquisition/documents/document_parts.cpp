#include "acquisition/documents/document_parts.hpp"

#include "acquisition/runfile/digest.hpp"
#include "acquisition/runfile/row.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "config/json_text.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace axiscal {

using Json = nlohmann::ordered_json;

namespace {

/// A part of a document without its uncertainties, which no digest covers either.
Json figures_in(const Json& document, const char* part) {
    Json figures = document.contains(part) ? document[part] : Json{};
    for (Json& figure : figures)
        if (figure.is_object()) figure.erase("expanded_uncertainty");
    return figures;
}

/// True where each figure stored agrees with the one of now, and none stands on one side alone.
bool agrees(const StoredResult& stored, const ComputedFigures& now) {
    const Json written = Json::parse(stored.document, nullptr, false);
    if (!written.is_object()) return false;
    const Json anew = now.document();
    return std::ranges::all_of(std::array{"parameters", "positions"}, [&](const char* part) {
        return disagreements(figures_in(written, part), figures_in(anew, part), now.agreement)
            .empty();
    });
}

} // namespace

std::string digest_of_figures(std::string format, std::span<const double> figures) {
    for (const double figure : figures)
        put_u64(format, std::bit_cast<std::uint64_t>(figure));
    return sha256_hex(format);
}

Result<std::string> standing_digest(const std::string& run_file,
                                    const ComputedFigures& now,
                                    const std::string& besides) {
    const auto stored = read_stored_result(run_file);
    if (!stored && stored.error().fault == Fault::not_found) return now.digest;
    if (!stored) return tl::unexpected<Error>(stored.error());
    const bool exact = now.agreement.absolute == 0 && now.agreement.relative == 0;
    if (stored->digest == now.digest || (!exact && agrees(*stored, now))) return stored->digest;
    return fail(Fault::bad_run_file, run_file + ": the figures recomputed now (" + now.digest +
                                         ") are not those of its first evaluation (" +
                                         stored->digest + ")" + besides);
}

Json test_run_json(const RunRecord& run,
                   const std::string& run_file_sha256,
                   const std::string& result_digest) {
    Json object;
    object["id"] = run.run_id;
    object["station"] = run.station;
    object["started"] = iso8601_utc(run.opened.utc_ns);
    object["finished"] = iso8601_utc(run.closed.utc_ns);
    object["software_version"] = run.software_version;
    object["run_file_sha256"] = run_file_sha256;
    object["config_sha256"] = run.config_hash;
    object["result_digest"] = result_digest;
    return object;
}

std::string document_text(const Json& document) {
    constexpr int indent = 1;
    return json_text(document, indent) + "\n";
}

} // namespace axiscal
