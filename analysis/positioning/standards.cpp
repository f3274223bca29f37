#include "analysis/positioning/standards.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace axiscal {
namespace {

constexpr std::string_view certain = "certain", from_memory = "from memory", doubtful = "doubtful";
constexpr std::string_view of_1988 = "ISO 230-2:1988", of_1997 = "ISO 230-2:1997",
                           of_2006 = "ISO 230-2:2006", of_2014 = "ISO 230-2:2014";

constexpr PositioningStandard iso(std::string_view name, double k, std::string_view same_as) {
    return {name, PositioningFigures::iso_230_2, k, same_as, certain, {}};
}
constexpr PositioningStandard
remembered(std::string_view name, double k, std::string_view same_as, std::string_view note) {
    return {name, PositioningFigures::iso_230_2, k, same_as, from_memory, note};
}
constexpr PositioningStandard own(std::string_view name,
                                  PositioningFigures figures,
                                  double k,
                                  std::string_view confidence,
                                  std::string_view note) {
    return {name, figures, k, {}, confidence, note};
}

constexpr std::array standards{
    iso("ISO 230-2:2014", 2, of_2014),
    iso("ISO 230-2:2006", 2, of_2006),
    iso("ISO 230-2:1997", 2, of_1997),
    iso("ISO 230-2:1988", 3, of_1988),
    iso("GB 10931-89", 3, of_1988),
    iso("GB/T 17421.2-2000", 2, of_1997),
    iso("GB/T 17421.2-2016", 2, of_2006),
    iso("GB/T 17421.2-2023", 2, of_2014),
    iso("GOST ISO 230-2-2016", 2, of_2014),
    remembered("BS 4656-16 style",
               3,
               of_1988,
               "taken as the family of ISO 230-2:1988 (3 s); the standard itself was not seen"),
    remembered("BS 3800 style",
               3,
               of_1988,
               "taken as the family of ISO 230-2:1988 (3 s); the standard itself was not seen"),
    remembered("ASME B5.54-2005",
               2,
               of_1997,
               "taken as the formulas of ISO 230-2:1997 with k = 2; the standard was not seen"),
    remembered("JIS B 6190-2",
               2,
               of_2014,
               "taken as equal to ISO 230-2 with k = 2; the standard was not seen"),
    own("VDI/DGQ 3441", PositioningFigures::vdi_3441, 3, certain, {}),
    own("raw ranges",
        PositioningFigures::raw_ranges,
        0,
        "certain by name",
        "the primed parameters of commercial software; R_raw as the range of both directions' "
        "readings at one target is reconstructed"),
    own("ASME B5.54-1992 style",
        PositioningFigures::asme_b554_1992,
        0,
        doubtful,
        "style: ranges of raw readings instead of standard deviations; the standard was not seen"),
    own("NMTBA style, with offset",
        PositioningFigures::nmtba_with_offset,
        3,
        doubtful,
        "style: half widths (plus or minus) of three standard deviations; no primary source was "
        "seen"),
    own("NMTBA style, without offset",
        PositioningFigures::nmtba_without_offset,
        3,
        doubtful,
        "style: half widths (plus or minus) of three standard deviations, the mean of all mean "
        "deviations taken out first; no primary source was seen"),
    own("JIS B 6330 style",
        PositioningFigures::jis_b_6330,
        0,
        from_memory,
        "style: ranges at both ends and the middle; the standard was not seen"),
    own("JIS B 6201 style",
        PositioningFigures::jis_b_6330,
        0,
        from_memory,
        "style: evaluated as JIS B 6330 style; the standard was not seen"),
};

struct Wording {
    std::string_view key, symbol, name, old_name;
    std::string_view subscript; ///< of the axis notation; "" for none
};

// The directions are added below.
constexpr std::array wordings{
    Wording{"A", "A", "bidirectional accuracy of positioning", {}, "A"},
    Wording{"A_forward", "A", "unidirectional accuracy of positioning", {}, "A"},
    Wording{"A_backward", "A", "unidirectional accuracy of positioning", {}, "A"},
    Wording{"E", "E", "bidirectional systematic positioning error",
            "bidirectional systematic deviation of positioning", "E"},
    Wording{"E_forward", "E", "unidirectional systematic positioning error",
            "unidirectional systematic deviation of positioning", "E"},
    Wording{"E_backward", "E", "unidirectional systematic positioning error",
            "unidirectional systematic deviation of positioning", "E"},
    Wording{"M", "M", "mean bidirectional positioning error",
            "mean bidirectional positional deviation", "M"},
    Wording{"R", "R", "bidirectional repeatability of positioning", {}, "R"},
    Wording{"R_forward", "R", "unidirectional repeatability of positioning", {}, "R"},
    Wording{"R_backward", "R", "unidirectional repeatability of positioning", {}, "R"},
    Wording{"B", "B", "reversal error", "reversal value", "B"},
    Wording{"B_mean", "B̄", "mean reversal error", "mean reversal value", {}},
};

bool is_one_letter(std::string_view axis) {
    return axis.size() == 1 && std::isalpha(static_cast<unsigned char>(axis.front())) != 0;
}

} // namespace

std::span<const PositioningStandard> positioning_standards() {
    return standards;
}

const PositioningStandard* find_positioning_standard(std::string_view name) {
    const auto* found = std::ranges::find(standards, name, &PositioningStandard::name);
    return found == standards.end() ? nullptr : found;
}

FigureLabel figure_label(std::string_view key, std::string_view same_as, std::string_view axis) {
    const auto* wording = std::ranges::find(wordings, key, &Wording::key);
    if (wording == wordings.end()) return {};
    const bool newest = same_as == of_2014;
    const std::string_view arrow = key.ends_with("_forward")    ? "↑"
                                   : key.ends_with("_backward") ? "↓"
                                                                : "";
    const std::string_view way = key.ends_with("_forward")    ? ", positive direction"
                                 : key.ends_with("_backward") ? ", negative direction"
                                                              : "";
    const auto name = newest || wording->old_name.empty() ? wording->name : wording->old_name;
    FigureLabel label{
        std::string{wording->symbol}.append(arrow), std::string{name}.append(way), {}};
    if (newest && is_one_letter(axis) && !wording->subscript.empty())
        label.axis_symbol = "E_" + std::string{axis} + std::string{axis} + "," +
                            std::string{wording->subscript}.append(arrow);
    return label;
}

} // namespace axiscal
