#include "acquisition/runfile/receipt.hpp"

#include "acquisition/runfile/run_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

std::optional<Digest> digest_from(const Json& text) {
    Digest digest{};
    if (!text.is_string() || text.get_ref<const std::string&>().size() != 2 * digest.size() ||
        text.get_ref<const std::string&>().find_first_not_of("0123456789abcdef") !=
            std::string::npos)
        return std::nullopt;
    for (std::size_t i = 0; i < digest.size(); ++i)
        digest[i] = static_cast<std::uint8_t>(
            std::stoi(text.get_ref<const std::string&>().substr(2 * i, 2), nullptr, 16));
    return digest;
}

/// Empty for what has another form.
std::optional<ClosingMark> mark_from(const Json& closing, const std::string& run_id) {
    if (!closing.is_object() || !closing.contains("number") || !closing.contains("hash") ||
        !closing.contains("result_hash") || !closing["number"].is_number_integer())
        return std::nullopt;
    const auto hash = digest_from(closing["hash"]);
    const auto result = digest_from(closing["result_hash"]);
    if (!hash || (!result && !closing["result_hash"].is_null())) return std::nullopt;
    const auto number = std::clamp<std::int64_t>(closing["number"].get<std::int64_t>(), 0, 100'000);
    return ClosingMark{run_id, static_cast<int>(number), *hash, result};
}

Result<Json> read_receipt(const std::string& path) {
    std::ifstream file{path, std::ios::binary};
    if (!file || std::filesystem::is_directory(path))
        return fail(Fault::not_found, "cannot read " + path);
    const std::string text{std::istreambuf_iterator<char>{file}, {}};
    Json receipt = Json::parse(text, nullptr, false);
    const bool known = receipt.is_object() && receipt.contains("format") &&
                       receipt["format"] == "axiscal.receipt/1" && receipt.contains("run_id") &&
                       receipt["run_id"].is_string() && receipt.contains("files") &&
                       receipt["files"].is_array();
    if (!known)
        return fail(Fault::bad_case,
                    path + " is no receipt: receipt.json of the run's folder under published/ is");
    return receipt;
}

bool names_file(const Json& receipt, const std::string& file_sha256) {
    return std::ranges::any_of(receipt["files"], [&](const Json& file) {
        return file.is_object() && file.contains("sha256") && file["sha256"] == file_sha256;
    });
}

/// The receipt names the entry, which bears the run's id or, of a later closing, one made of it.
std::string run_of(const Json& receipt, const Json& closing) {
    return closing.is_object() && closing.contains("run_id") && closing["run_id"].is_string()
               ? closing["run_id"].get<std::string>()
               : receipt["run_id"].get<std::string>();
}

} // namespace

Json closing_json(const std::optional<ClosingMark>& mark) {
    if (!mark) return {};
    return {{"run_id", mark->run_id},
            {"number", mark->closing},
            {"hash", hex_of(mark->closing_hash)},
            {"result_hash", mark->result_hash ? Json(hex_of(*mark->result_hash)) : Json{}}};
}

Result<AnchorReport> compare_with_receipt(const std::string& run_file,
                                          const std::string& file_sha256,
                                          const std::string& receipt) {
    AXISCAL_TRY(const Json document, read_receipt(receipt));
    const Json closing = document.contains("closing") ? document["closing"] : Json{};
    if (!closing.is_null()) {
        const auto mark = mark_from(closing, run_of(document, closing));
        if (!mark) return fail(Fault::bad_case, receipt + ": its member \"closing\" is damaged");
        return compare_with_anchor(run_file, *mark);
    }
    if (names_file(document, file_sha256))
        return AnchorReport{AnchorVerdict::match, "the receipt names the SHA-256 of this file"};
    return AnchorReport{AnchorVerdict::differs,
                        "the receipt names no file with the SHA-256 of this one"};
}

} // namespace axiscal
