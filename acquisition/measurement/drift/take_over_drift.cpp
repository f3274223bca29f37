#include "acquisition/measurement/drift/take_over_drift.hpp"

#include "analysis/record/run_attachments.hpp"

#include <string>
#include <variant>

namespace axiscal {

Task<Result<TakenOver>> take_over_drift(LeftRun left) {
    const auto* setup = std::get_if<DriftSetup>(&left.contents.attachments.setup);
    const bool of_bar = setup != nullptr && setup->of_bar;
    TakenOver taken;
    taken.closing.reason = std::string{"Nobody watched the resting "} +
                           (of_bar ? "ballbar" : "axis") + " while the station was away.";
    taken.closing.fault = Fault::datum_lost;
    co_return taken;
}

} // namespace axiscal
