#include "analysis/positioning/styles.hpp"

namespace axiscal {

StyleResult evaluate_style(PositioningFigures figures, const RunAt20C& run) {
    switch (figures) {
    case PositioningFigures::vdi_3441: return evaluate_vdi_3441(run);
    case PositioningFigures::asme_b554_1992: return evaluate_asme_b554_1992(run);
    case PositioningFigures::nmtba_with_offset: return evaluate_nmtba(run, true);
    case PositioningFigures::nmtba_without_offset: return evaluate_nmtba(run, false);
    case PositioningFigures::jis_b_6330: return evaluate_jis_b_6330(run);
    case PositioningFigures::raw_ranges:
    case PositioningFigures::iso_230_2: break;
    }
    return evaluate_raw_ranges(run);
}

} // namespace axiscal
