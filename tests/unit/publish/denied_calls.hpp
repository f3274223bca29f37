#pragma once
// What the disk of another PC answers: calls of the C library in this test program that a
// file system may not know, or that lead to another disk. And the power cut before any of them.

#include <string>

namespace axiscal::testing {

/// While it lives, in this process and its children. One at a time.
struct DeniedCalls {
    std::string from, to;             ///< only names that begin so; empty: any
    int rename_to_free = 0, link = 0; ///< errno; 0: as the kernel answers
    int rename = 0;
    int sync = 0;   ///< of any file
    int die_at = 0; ///< before this one of all renames and syncs, from 1; 0: never

    DeniedCalls();
    ~DeniedCalls();
    DeniedCalls(const DeniedCalls&) = delete;
    DeniedCalls& operator=(const DeniedCalls&) = delete;
};

} // namespace axiscal::testing
