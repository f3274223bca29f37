#include "acquisition/runfile/run_signature.hpp"

#include "acquisition/runfile/run_file.hpp"
#include "acquisition/runfile/run_file_open.hpp"
#include "acquisition/runfile/statement.hpp"

#include <algorithm>
#include <vector>

namespace axiscal {
namespace {

constexpr Table signed_row{"signature", "run_id, closing, closing_hash, result_hash", "tibB"};

template <class Bytes> Blob as_blob(const Bytes& bytes) {
    return Blob{std::string{bytes.begin(), bytes.end()}};
}

/// Empty for what is no such number of bytes.
template <class Bytes> std::optional<Bytes> bytes_from(const Value& value) {
    const auto* blob = std::get_if<Blob>(&value);
    Bytes bytes{};
    if (blob == nullptr || blob->bytes.size() != bytes.size()) return std::nullopt;
    std::ranges::transform(blob->bytes, bytes.begin(),
                           [](char byte) { return static_cast<std::uint8_t>(byte); });
    return bytes;
}

Result<std::vector<Row>> every_row(const Database& database, const std::string& sql) {
    AXISCAL_TRY(auto select, database.prepare(sql));
    std::vector<Row> rows;
    for (;;) {
        AXISCAL_TRY(const bool more, select.step());
        if (!more) return rows;
        Row row;
        for (int i = 0; i < select.column_count(); ++i)
            row.push_back(select.column(i));
        rows.push_back(std::move(row));
    }
}

Result<std::vector<Value>> every_value(const Database& database, const std::string& sql) {
    AXISCAL_TRY(const auto rows, every_row(database, sql));
    std::vector<Value> values;
    for (const Row& row : rows)
        values.push_back(row.front());
    return values;
}

struct SignedFile {
    std::string run_id;
    std::vector<Value> closings, results; ///< hashes, in their order
    std::vector<Row> signatures;          ///< closing, closing_hash, result_hash, key, signature
    bool closed = false;
};

Result<SignedFile> look_into(const Database& database) {
    SignedFile file;
    AXISCAL_TRY(const auto id, database.value_of("SELECT run_id FROM run"));
    if (const auto* text = std::get_if<std::string>(&id)) file.run_id = *text;
    AXISCAL_TRY(file.closings, every_value(database, "SELECT hash FROM closing ORDER BY link"));
    AXISCAL_TRY(file.results, every_value(database, "SELECT hash FROM result ORDER BY id"));
    AXISCAL_TRY(file.closed, is_run_closed(database));
    AXISCAL_TRY(file.signatures,
                every_row(database, "SELECT closing, closing_hash, result_hash, public_key, "
                                    "signature FROM signature ORDER BY id"));
    return file;
}

/// Why a signature is none; empty when it holds.
std::string fault_of(const SignedFile& file, const Row& row, std::span<const PublicKey> known) {
    const auto* number = std::get_if<std::int64_t>(&row[0]);
    const auto hash = bytes_from<Digest>(row[1]);
    const auto result = bytes_from<Digest>(row[2]);
    const auto key = bytes_from<PublicKey>(row[3]);
    const auto signature = bytes_from<Signature>(row[4]);
    if (!number || !hash || !key || !signature || (!result && row[2] != Value{}))
        return "a signature has another form";
    const auto count = static_cast<std::int64_t>(file.closings.size());
    const std::string name = "the signature of closing " + std::to_string(*number);
    if (*number < 1 || *number > count) return name + " is of a closing that is not in the file";
    if (file.closings[static_cast<std::size_t>(*number - 1)] != row[1])
        return name + " is of other rows than those of this file";
    if (result && std::ranges::find(file.results, row[2]) == file.results.end())
        return name + " is of a result that is not in the file";
    if (std::ranges::find(known, *key) == known.end())
        return name + " was made with the key " + short_name_of(*key) +
               ", which is none of those given";
    const ClosingMark mark{file.run_id, static_cast<int>(*number), *hash, result};
    return is_signed_by(*key, signed_bytes(mark), *signature)
               ? std::string{}
               : name + " does not fit: run id, closing or result were changed, or it was forged";
}

bool bears_signature(const SignedFile& file, std::size_t column, const Value& hash) {
    return std::ranges::any_of(file.signatures,
                               [&](const Row& row) { return row[column] == hash; });
}

/// What nobody signed although the rest is; empty when there is nothing.
std::string unsigned_part(const SignedFile& file) {
    for (std::size_t i = 0; i < file.closings.size(); ++i)
        if (!bears_signature(file, 1, file.closings[i]))
            return "closing " + std::to_string(i + 1) + " bears no signature";
    for (std::size_t i = 0; i < file.results.size(); ++i)
        if (!bears_signature(file, 2, file.results[i]))
            return "result " + std::to_string(i + 1) + " bears no signature";
    return {};
}

std::string keys_text(const SignedFile& file) {
    std::vector<std::string> names;
    for (const Row& row : file.signatures)
        if (const auto key = bytes_from<PublicKey>(row[3])) names.push_back(short_name_of(*key));
    std::ranges::sort(names);
    names.erase(std::ranges::unique(names).begin(), names.end());
    std::string words;
    for (const std::string& name : names)
        words += (words.empty() ? "" : ", ") + name;
    return words;
}

std::string difference(const SignedFile& file, const ClosingMark& anchor) {
    if (file.run_id != anchor.run_id) return "the receipt is of run " + anchor.run_id;
    const std::string name = "closing " + std::to_string(anchor.closing);
    if (anchor.closing < 1 || static_cast<std::size_t>(anchor.closing) > file.closings.size())
        return "the receipt knows a " + name + ", which is not in the file";
    const bool newest = static_cast<std::size_t>(anchor.closing) == file.closings.size();
    if (file.closings[static_cast<std::size_t>(anchor.closing - 1)] !=
        Value{as_blob(anchor.closing_hash)})
        return "the rows up to " + name + " are not those of the receipt";
    if (!anchor.result_hash) return {};
    const Value result{as_blob(*anchor.result_hash)};
    const bool kept = newest ? !file.results.empty() && file.results.back() == result
                             : std::ranges::find(file.results, result) != file.results.end();
    return kept ? std::string{} : "the result of " + name + " is not that of the receipt";
}

} // namespace

std::string signed_bytes(const ClosingMark& mark) {
    Value result;
    if (mark.result_hash) result = as_blob(*mark.result_hash);
    return canonical_bytes(
        signed_row, {mark.run_id, std::int64_t{mark.closing}, as_blob(mark.closing_hash), result});
}

Result<void> append_signature(Database& database,
                              const SecretKey& key,
                              const std::optional<Digest>& result_hash) {
    AXISCAL_TRY(const SignedFile file, look_into(database));
    const auto hash =
        file.closings.empty() ? std::nullopt : bytes_from<Digest>(file.closings.back());
    if (!hash) return fail(Fault::internal, "nothing is closed that could be signed");
    const ClosingMark mark{file.run_id, static_cast<int>(file.closings.size()), *hash, result_hash};
    Value result;
    if (result_hash) result = as_blob(*result_hash);
    AXISCAL_TRY(auto insert,
                database.prepare("INSERT INTO signature(closing, closing_hash, result_hash, "
                                 "public_key, signature) VALUES(?,?,?,?,?)"));
    AXISCAL_CHECK(insert.bind({std::int64_t{mark.closing}, as_blob(*hash), result,
                               as_blob(key.public_key()), as_blob(key.sign(signed_bytes(mark)))}));
    if (auto stepped = insert.step(); !stepped) return tl::unexpected<Error>(stepped.error());
    return {};
}

Result<bool> is_closing_signed(const Database& database) {
    AXISCAL_TRY(const auto found,
                database.integer_of("SELECT count(*) FROM signature WHERE closing=(SELECT "
                                    "count(*) FROM closing)"));
    return found != 0;
}

Result<ClosingMark> last_closing_mark(const std::string& run_file) {
    AXISCAL_TRY(const auto database, open_run_file(run_file));
    AXISCAL_TRY(const SignedFile file, look_into(*database));
    const auto hash =
        file.closings.empty() ? std::nullopt : bytes_from<Digest>(file.closings.back());
    if (!file.closed || !hash) return fail(Fault::refused, run_file + " is still open");
    const auto result =
        file.results.empty() ? std::nullopt : bytes_from<Digest>(file.results.back());
    return ClosingMark{file.run_id, static_cast<int>(file.closings.size()), *hash, result};
}

std::string_view name_of(SignatureVerdict verdict) {
    switch (verdict) {
    case SignatureVerdict::good: return "good";
    case SignatureVerdict::bad: return "bad";
    case SignatureVerdict::absent: return "absent";
    case SignatureVerdict::unknown_key: return "unknown_key";
    }
    return "?";
}

std::string_view name_of(AnchorVerdict verdict) {
    switch (verdict) {
    case AnchorVerdict::match: return "match";
    case AnchorVerdict::differs: return "differs";
    case AnchorVerdict::absent: return "absent";
    }
    return "?";
}

Result<SignatureReport> check_signatures(const std::string& run_file,
                                         std::span<const PublicKey> known) {
    AXISCAL_TRY(const auto database, open_run_file(run_file));
    AXISCAL_TRY(const SignedFile file, look_into(*database));
    if (file.signatures.empty())
        return SignatureReport{SignatureVerdict::absent, "nothing in the file is signed"};
    if (known.empty())
        return SignatureReport{
            SignatureVerdict::unknown_key,
            "signed with the key " + keys_text(file) +
                "; --public-key with the station's public-keys.pem shows whether "
                "it is the station's"};
    for (const Row& row : file.signatures)
        if (std::string why = fault_of(file, row, known); !why.empty())
            return SignatureReport{SignatureVerdict::bad, std::move(why)};
    if (std::string why = unsigned_part(file); !why.empty())
        return SignatureReport{SignatureVerdict::bad, std::move(why)};
    return SignatureReport{SignatureVerdict::good, "signed with the key " + keys_text(file)};
}

Result<AnchorReport> compare_with_anchor(const std::string& run_file, const ClosingMark& anchor) {
    AXISCAL_TRY(const auto database, open_run_file(run_file));
    AXISCAL_TRY(const SignedFile file, look_into(*database));
    std::string why = difference(file, anchor);
    if (!why.empty()) return AnchorReport{AnchorVerdict::differs, std::move(why)};
    return AnchorReport{AnchorVerdict::match,
                        "closing " + std::to_string(anchor.closing) + " is that of the receipt"};
}

} // namespace axiscal
