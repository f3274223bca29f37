#pragma once
// A run file evaluated, as the kind of result that the test expects.

#include "acquisition/documents/evaluate.hpp"

namespace axiscal::test {

template <class Kind>
Result<Kind> evaluated(const std::string& path, const Issue* issue = nullptr) {
    auto result = evaluate_run_file(path, issue);
    if (!result) return tl::unexpected<Error>(result.error());
    return std::get<Kind>(*std::move(result));
}

/// The first evaluation, unsigned and without a number.
inline Result<TestResult> stored_first(const std::string& path) {
    const Issue plain;
    return evaluate_run_file(path, &plain);
}

} // namespace axiscal::test
