#include "acquisition/runfile/row.hpp"

#include <array>
#include <bit>
#include <cctype>
#include <cmath>

namespace axiscal {
namespace {

constexpr std::string_view tags = "nirtb"; // in the order of Value's alternatives

std::string column_name(const Table& table, std::size_t index) {
    std::string_view rest = table.columns;
    for (; index > 0; --index) {
        const auto comma = rest.find(',');
        if (comma == std::string_view::npos) return "?";
        rest.remove_prefix(comma + 1);
    }
    rest = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.find_first_not_of(" \n"), rest.size()));
    return std::string{table.name} + "." + std::string{rest};
}

void put_value(std::string& bytes, const Value& value) {
    bytes += tags[value.index()];
    const auto put_text = [&](const std::string& text) {
        put_u64(bytes, text.size());
        bytes += text;
    };
    if (const auto* integer = std::get_if<std::int64_t>(&value))
        put_u64(bytes, static_cast<std::uint64_t>(*integer));
    if (const auto* real = std::get_if<double>(&value))
        put_u64(bytes, std::bit_cast<std::uint64_t>(*real));
    if (const auto* text = std::get_if<std::string>(&value)) put_text(*text);
    if (const auto* blob = std::get_if<Blob>(&value)) put_text(blob->bytes);
}

} // namespace

Result<void> check_row(const Table& table, const Row& row) {
    if (row.size() != table.types.size())
        return fail(Fault::bad_run_file, std::string{table.name} + " has another column count");
    for (std::size_t i = 0; i < row.size(); ++i) {
        const auto type = static_cast<unsigned char>(table.types[i]);
        const bool absent = row[i].index() == 0 && std::isupper(type) != 0;
        if (!absent && tags[row[i].index()] != static_cast<char>(std::tolower(type)))
            return fail(Fault::bad_run_file, column_name(table, i) + " has another type");
        if (const auto* real = std::get_if<double>(&row[i]); real && !std::isfinite(*real))
            return fail(Fault::bad_run_file, column_name(table, i) + " is not a finite number");
    }
    return {};
}

std::string canonical_bytes(const Table& table, const Row& row) {
    std::string bytes;
    put_value(bytes, std::string{table.name});
    for (const auto& value : row)
        put_value(bytes, value);
    return bytes;
}

// Eight bytes at a time: the window of a point has three thousand such words.
void put_u64(std::string& bytes, std::uint64_t word) {
    std::array<char, sizeof word> little{};
    for (std::size_t i = 0; i < little.size(); ++i)
        little[i] = static_cast<char>(static_cast<unsigned char>(word >> (8 * i)));
    bytes.append(little.data(), little.size());
}

std::uint64_t get_u64(std::string_view bytes) {
    std::uint64_t word = 0;
    for (std::size_t i = 8; i-- > 0;)
        word = word << 8U | static_cast<unsigned char>(bytes[i]);
    return word;
}

std::int64_t RowReader::bounded(std::int64_t low, std::int64_t high) {
    const auto value = integer();
    if (value >= low && value <= high) return value;
    return reject(std::to_string(value) + " is out of range"), low;
}

void RowReader::reject(std::string reason) {
    if (error_) return;
    error_ = Error{Fault::bad_run_file,
                   column_name(table_, place_ > 0 ? place_ - 1 : 0) + ": " + std::move(reason),
                   {},
                   {}};
}

Result<void> RowReader::status() const {
    if (error_) return tl::unexpected<Error>(*error_);
    return {};
}

} // namespace axiscal
