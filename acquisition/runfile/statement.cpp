#include "acquisition/runfile/statement.hpp"

#include <cerrno>
#include <sqlite3.h>

namespace axiscal {
namespace {

constexpr int longest_value = 64 << 20; // a window of 1 s at 1 MHz is 24 MB
constexpr int busy_ms = 2000;           // a reader holds the file for milliseconds

int bind_value(sqlite3_stmt* statement, int place, const Value& value) {
    if (const auto* integer = std::get_if<std::int64_t>(&value))
        return sqlite3_bind_int64(statement, place, *integer);
    if (const auto* real = std::get_if<double>(&value))
        return sqlite3_bind_double(statement, place, *real);
    if (const auto* text = std::get_if<std::string>(&value))
        return sqlite3_bind_text64(statement, place, text->data(), text->size(), SQLITE_TRANSIENT,
                                   SQLITE_UTF8);
    if (const auto* blob = std::get_if<Blob>(&value))
        return sqlite3_bind_blob64(statement, place, blob->bytes.data(), blob->bytes.size(),
                                   SQLITE_TRANSIENT);
    return sqlite3_bind_null(statement, place);
}

void distrust(sqlite3* connection) {
    sqlite3_limit(connection, SQLITE_LIMIT_LENGTH, longest_value);
    sqlite3_db_config(connection, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(connection, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    sqlite3_db_config(connection, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
    sqlite3_db_config(connection, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
    sqlite3_busy_timeout(connection, busy_ms);
}

} // namespace

void Statement::Finalize::operator()(sqlite3_stmt* statement) const {
    sqlite3_finalize(statement);
}

Result<void> Statement::bind(const Row& values, int first) {
    sqlite3_reset(statement_.get());
    for (const auto& value : values)
        if (bind_value(statement_.get(), first++, value) != SQLITE_OK) return owner_->failure();
    return {};
}

Result<bool> Statement::step() {
    const int outcome = sqlite3_step(statement_.get());
    if (outcome == SQLITE_ROW) return true;
    if (outcome == SQLITE_DONE) return false;
    return owner_->failure();
}

int Statement::column_count() const {
    return sqlite3_column_count(statement_.get());
}

Value Statement::column(int index) const {
    const auto size = [&] {
        return static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), index));
    };
    switch (sqlite3_column_type(statement_.get(), index)) {
    case SQLITE_INTEGER: return std::int64_t{sqlite3_column_int64(statement_.get(), index)};
    case SQLITE_FLOAT: return sqlite3_column_double(statement_.get(), index);
    case SQLITE_TEXT: {
        const auto* text = sqlite3_column_text(statement_.get(), index);
        return text ? std::string{reinterpret_cast<const char*>(text), size()} : std::string{};
    }
    case SQLITE_BLOB: {
        const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement_.get(), index));
        return bytes ? Blob{std::string{bytes, size()}} : Blob{};
    }
    default: return std::monostate{};
    }
}

void Database::Close::operator()(sqlite3* connection) const {
    sqlite3_close_v2(connection);
}

Result<std::unique_ptr<Database>>
Database::open(const std::string& path, Access access, Fault fault) {
    sqlite3* connection = nullptr;
    const int flags = (access == Access::read_only ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE) |
                      SQLITE_OPEN_PRIVATECACHE | SQLITE_OPEN_EXRESCODE;
    const int outcome = sqlite3_open_v2(path.c_str(), &connection, flags, nullptr);
    std::unique_ptr<Database> database{new Database{connection, path, fault}};
    if (outcome != SQLITE_OK) return database->failure();
    distrust(connection);
    AXISCAL_CHECK(database->execute("PRAGMA cell_size_check=ON; PRAGMA mmap_size=0;"));
    return database;
}

Result<std::unique_ptr<Database>> Database::in_memory() {
    return open(":memory:", Access::read_write, Fault::internal);
}

Result<void> Database::execute(const std::string& sql) {
    if (sqlite3_exec(connection_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
        return failure();
    return {};
}

Result<Statement> Database::prepare(const std::string& sql) const {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(connection_.get(), sql.c_str(), static_cast<int>(sql.size()), &statement,
                           nullptr) != SQLITE_OK)
        return failure();
    return Statement{statement, *this};
}

Result<Value> Database::value_of(const std::string& sql) const {
    AXISCAL_TRY(auto statement, prepare(sql));
    AXISCAL_TRY(const bool found, statement.step());
    return found ? statement.column(0) : Value{};
}

Result<std::int64_t> Database::integer_of(const std::string& sql) const {
    AXISCAL_TRY(const auto value, value_of(sql));
    const auto* integer = std::get_if<std::int64_t>(&value);
    return integer ? *integer : 0;
}

namespace {

/// What ended the last call on a file that failed; 0: none did, or it is not known.
int last_errno_of(sqlite3_file* file) {
    int code = 0;
    if (file != nullptr && file->pMethods != nullptr)
        file->pMethods->xFileControl(file, SQLITE_FCNTL_LAST_ERRNO, &code);
    return code;
}

/// By the file itself, the log or the main one: sqlite3_system_errno gives what errno holds when
/// the statement ends, which is as often that of the calls with which SQLite tidied up.
int errno_of_files(sqlite3* connection) {
    for (const int which : {SQLITE_FCNTL_JOURNAL_POINTER, SQLITE_FCNTL_FILE_POINTER}) {
        sqlite3_file* file = nullptr;
        if (sqlite3_file_control(connection, "main", which, &file) != SQLITE_OK) continue;
        if (const int code = last_errno_of(file); code != 0) return code;
    }
    return 0;
}

} // namespace

bool Database::is_held() const {
    return (sqlite3_errcode(connection_.get()) & 0xff) == SQLITE_BUSY;
}

tl::unexpected<Error> Database::failure() const {
    int system = connection_ ? sqlite3_system_errno(connection_.get()) : 0;
    const int kind = connection_ ? sqlite3_extended_errcode(connection_.get()) : SQLITE_NOMEM;
    // For these SQLite keeps no errno, or not always.
    if (kind == SQLITE_FULL) system = ENOSPC;
    if (kind == SQLITE_READONLY) system = EROFS;
    if ((kind & 0xff) == SQLITE_IOERR) {
        if (const int of_file = errno_of_files(connection_.get()); of_file != 0) system = of_file;
        if (system == 0) system = EIO;
    }
    const char* word = connection_ ? sqlite3_errmsg(connection_.get()) : "out of memory";
    const std::error_code cause =
        system != 0 ? std::error_code{system, std::generic_category()} : std::error_code{};
    return fail(fault_, path_ + ": " + word, cause);
}

} // namespace axiscal
