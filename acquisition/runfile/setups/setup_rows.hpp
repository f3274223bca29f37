#pragma once
// What only one kind of test has in its run file. Each kind is two files in this folder: NAME.sql
// makes its tables, NAME.cpp defines NAME_setup_rows, which says what stands in them. What a kind
// got later is a further pair, NAME_MORE.sql and NAME_MORE.cpp: a run file made before has none of
// its tables. CMake lists them. Pure.

#include "acquisition/runfile/record_readers.hpp"

#include <span>
#include <variant>
#include <vector>

namespace axiscal {

struct DescribedTable {
    Table table;
    record_readers::ReadRow* read;
};

struct SetupRows {
    TestKind kind;
    std::span<const DescribedTable> tables;
    std::vector<ChainedRow> (*rows)(const TestSetup& setup); ///< `setup` is of this kind
};

/// At least one for each kind that has a set-up; of one kind NAME before NAME_MORE, in which
/// order its rows are written. (Made from schema.cpp.in.)
std::span<const SetupRows* const> setup_rows();
/// Those of them that schema.sql does not name: what came after format 1. A run file that was made
/// before one of them has none of its tables.
std::span<const SetupRows* const> later_setup_rows();

/// The set-up, made where none is there yet: the writer checks each row by itself.
template <class Setup> Setup& setup_of(RecordedRun& run, RowReader& in) {
    TestSetup& setup = run.attachments.setup;
    if (!std::holds_alternative<Setup>(setup)) {
        if (!std::holds_alternative<std::monostate>(setup))
            in.reject("stands beside the set-up of another kind of test");
        setup.emplace<Setup>();
    }
    return std::get<Setup>(setup);
}

/// The same, of which a file has one.
template <class Setup> Setup& only_setup_of(RecordedRun& run, RowReader& in) {
    if (std::holds_alternative<Setup>(run.attachments.setup)) in.reject("stands there twice");
    return setup_of<Setup>(run, in);
}

} // namespace axiscal
