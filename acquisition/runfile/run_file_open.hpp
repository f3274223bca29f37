#pragma once
// The first looks at a run file that its readers share: identity, schema, size, pages.

#include "acquisition/runfile/statement.hpp"

#include <memory>
#include <string>
#include <vector>

namespace axiscal {

/// In a read transaction: one state while a run goes on.
/// @errors Fault::not_found; Fault::bad_run_file when it is none, or of another format or schema.
Result<std::unique_ptr<Database>> open_run_file(const std::string& path);
/// A file without WAL is as long as its page count says. @errors Fault::bad_run_file.
Result<void> check_run_file_size(const Database& database, const std::string& path);
/// SQLite's own check of every page. @errors Fault::bad_run_file.
Result<void> check_run_file_pages(const Database& database, const std::string& path);
/// Those of chained_tables() that the file has, in their order. One that it has not is a table
/// without rows: the file was made before its kind of test was known.
/// @errors Fault::bad_run_file.
Result<std::vector<const Table*>> chained_tables_in(const Database& database);

} // namespace axiscal
