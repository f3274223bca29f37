#pragma once
// The few SQLite calls we need, with owners and Results. Used by one thread at a time.

#include "acquisition/runfile/row.hpp"

#include <memory>

struct sqlite3;
struct sqlite3_stmt;

namespace axiscal {

class Database;

/// One prepared statement.
class Statement {
public:
    /// Begins anew: binds the parameters from ?`first` on; what was bound before stays.
    Result<void> bind(const Row& values, int first = 1);
    /// true: a row stands in the columns; false: done.
    Result<bool> step();
    [[nodiscard]] Value column(int index) const;
    [[nodiscard]] int column_count() const;

private:
    friend class Database;
    struct Finalize {
        void operator()(sqlite3_stmt* statement) const;
    };
    Statement(sqlite3_stmt* statement, const Database& owner)
        : statement_{statement}
        , owner_{&owner} {}
    std::unique_ptr<sqlite3_stmt, Finalize> statement_;
    const Database* owner_;
};

/// One connection. Errors carry the fault given at open, the path and SQLite's own word.
class Database {
public:
    enum class Access { read_only, read_write };
    /// The file must exist. Nothing in it is trusted: views, triggers and foreign functions are
    /// off, cells are checked, no value is longer than 64 MiB.
    static Result<std::unique_ptr<Database>>
    open(const std::string& path, Access access, Fault fault);
    static Result<std::unique_ptr<Database>> in_memory();

    Result<void> execute(const std::string& sql);
    [[nodiscard]] Result<Statement> prepare(const std::string& sql) const;
    /// First column of the first row; NULL when there is none.
    [[nodiscard]] Result<Value> value_of(const std::string& sql) const;
    [[nodiscard]] Result<std::int64_t> integer_of(const std::string& sql) const;
    [[nodiscard]] tl::unexpected<Error> failure() const;
    /// The last call failed because another connection holds the file.
    [[nodiscard]] bool is_held() const;

private:
    struct Close {
        void operator()(sqlite3* connection) const;
    };
    Database(sqlite3* connection, std::string path, Fault fault)
        : connection_{connection}
        , path_{std::move(path)}
        , fault_{fault} {}
    std::unique_ptr<sqlite3, Close> connection_;
    std::string path_;
    Fault fault_;
};

} // namespace axiscal
