#pragma once
// A table row as plain values, and the bytes that its link of the hash chain is made of. Pure.

#include "acquisition/runfile/digest.hpp"
#include "analysis/quantity/quantity.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/quantity/time.hpp"

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace axiscal {

struct Blob {
    std::string bytes;
    bool operator==(const Blob&) const = default;
};

/// NULL, INTEGER, IEEE double, TEXT, BLOB.
using Value = std::variant<std::monostate, std::int64_t, double, std::string, Blob>;
using Row = std::vector<Value>;

/// A table without its columns `link` and `hash`, which all chained tables share.
struct Table {
    std::string_view name;
    std::string_view columns; ///< "step, target_index, ..."
    /// One letter a column: i integer, r double, t text, b blob; upper case may be NULL.
    std::string_view types;
};

/// Column count and types are those of the table and every double is finite.
/// @errors Fault::bad_run_file naming table and column.
Result<void> check_row(const Table& table, const Row& row);

/// What is hashed: table name, then each value as tag and little-endian payload (docs/run-file.md).
std::string canonical_bytes(const Table& table, const Row& row);

void put_u64(std::string& bytes, std::uint64_t word); ///< little-endian
std::uint64_t get_u64(std::string_view bytes);        ///< of the first 8 bytes

/// Reads a checked row in order. The first value out of range is remembered; `status()` tells it.
class RowReader {
public:
    RowReader(const Table& table, const Row& row)
        : table_{table}
        , row_{row} {}
    std::string text() { return take<std::string>(); }
    std::string blob() { return take<Blob>().bytes; }
    double real() { return take<double>(); }
    std::int64_t integer() { return take<std::int64_t>(); }
    std::optional<double> optional_real() { return optional<double>(); }
    std::optional<std::int64_t> optional_integer() { return optional<std::int64_t>(); }
    Length length() { return Length::from_si(real()); }
    MonotonicTime time() { return monotonic_from_ns(integer()); }
    bool flag() { return bounded(0, 1) != 0; }
    template <class Integer> Integer number() {
        return static_cast<Integer>(
            bounded(std::numeric_limits<Integer>::min(), std::numeric_limits<Integer>::max()));
    }
    /// The one of `all` whose name_of is stored here.
    template <class Choice> Choice choice(std::initializer_list<Choice> all) { return one_of(all); }
    template <class Choices> typename Choices::value_type one_of(const Choices& all) {
        const std::string name = text();
        for (const auto candidate : all)
            if (name_of(candidate) == name) return candidate;
        return reject("\"" + name + "\" is not known"), *all.begin();
    }
    void reject(std::string reason);
    [[nodiscard]] Result<void> status() const;

private:
    std::int64_t bounded(std::int64_t low, std::int64_t high);
    template <class T> T take() {
        const T* value = place_ < row_.size() ? std::get_if<T>(&row_[place_]) : nullptr;
        ++place_;
        if (value == nullptr) return reject("has another type"), T{};
        return *value;
    }
    template <class T> std::optional<T> optional() {
        if (place_ < row_.size() && std::holds_alternative<std::monostate>(row_[place_]))
            return ++place_, std::nullopt;
        return take<T>();
    }

    const Table& table_;
    const Row& row_;
    std::size_t place_ = 0;
    std::optional<Error> error_;
};

} // namespace axiscal
