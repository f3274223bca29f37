// certificate.json as a disk, or somebody who changed it, may give it back.

#include "acquisition/console/certificate_facts.hpp"
#include "tests/fuzz/judge.hpp"

#include <cmath>

using namespace axiscal;

namespace {

void judge_figure(const CertifiedFigure& figure) {
    for (const auto& number : {figure.value, figure.expanded_uncertainty, figure.limit})
        fuzz::require(!number || std::isfinite(*number), "a figure is a number");
    fuzz::require(figure.parameter.find('\n') == std::string::npos, "a name is one line");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto facts = facts_of_certificate(fuzz::as_text(data, size));
    if (!facts) {
        fuzz::require(!facts.error().detail.empty(), "a refusal has a reason");
        return 0;
    }
    fuzz::require(!facts->run_id.empty(), "a certificate is that of a run");
    fuzz::require(facts->figures.size() <= 40, "a row has room for so many figures");
    fuzz::require(!facts->partial || facts->verdict.empty(), "what is partial has no verdict");
    for (const CertifiedFigure& figure : facts->figures)
        judge_figure(figure);
    return 0;
}
