#pragma once
// What each kind of test says on its paper. PaperOf is specialised in the folder of the kind; one
// without it does not compile. Each specialisation has:
//
//   static constexpr TestKind kind;
//   /// Of a run file that was read: with the digest of its figures, without what the paper adds
//   /// (number, hash of the file).
//   static Result<Test> evaluated(const std::string& path, RunFileContents contents);
//   static nlohmann::ordered_json json(const Test& one);
//   static std::string csv(const Test& one);
//   static nlohmann::ordered_json figures(const Test& one); // what the run file keeps: no words
//   static FigureAgreement agreement(const Test& one);      // with those of another processor
//   static bool is_partial(const Test& one);                // it is neither stored nor numbered
//   static std::string finished_utc(const Test& one);       // empty: its paper gets no number
//   static Result<std::string> pdf(const Test& one);        // in the library that draws

#include "acquisition/documents/figure_agreement.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/test_kind.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace axiscal {

template <class Test> struct PaperOf;

} // namespace axiscal
