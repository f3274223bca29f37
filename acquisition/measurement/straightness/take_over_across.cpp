#include "acquisition/measurement/straightness/take_over_across.hpp"

#include "acquisition/measurement/positioning/take_over_positioning.hpp"
#include "acquisition/measurement/straightness/armed_straightness.hpp"

#include <utility>

namespace axiscal {

Task<Result<TakenOver>> take_over_across(PositioningContext context, LeftRun left) {
    auto reading = reading_across(context.config, left.contents.attachments);
    return take_over_read_by(context, std::move(left), std::move(reading));
}

Task<std::shared_ptr<Measurement>>
take_over_closed_across(PositioningContext context,
                        std::string path,
                        RunFileContents contents,
                        const SetUpWatch& set_up,
                        const std::optional<JournalReceipt>& told) {
    auto reading = reading_across(context.config, contents.attachments);
    return take_over_closed_read_by(context, std::move(path), std::move(contents),
                                    std::move(reading), set_up, told);
}

} // namespace axiscal
