#pragma once
// The standards a positioning test can be evaluated by, and how sure each one's formulas are. Pure.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace axiscal {

/// Which set of figures a standard asks for.
enum class PositioningFigures : std::uint8_t {
    iso_230_2,
    vdi_3441,
    raw_ranges,
    asme_b554_1992,
    nmtba_with_offset,
    nmtba_without_offset,
    jis_b_6330,
};

struct PositioningStandard {
    std::string_view name; ///< as a case writes it
    PositioningFigures figures = PositioningFigures::iso_230_2;
    double cover_factor = 2;     ///< k of the figures; 3 where a standard says 3 s or 6 s
    std::string_view same_as;    ///< the edition of ISO 230-2 with the same figures; or empty
    std::string_view confidence; ///< "certain" | "from memory" | "doubtful", of the formulas
    std::string_view note;       ///< printed with the result; may be empty
    [[nodiscard]] bool is_iso() const { return figures == PositioningFigures::iso_230_2; }
};

/// Every standard known here, the editions of ISO 230-2 first.
std::span<const PositioningStandard> positioning_standards();

/// nullptr for an unknown name.
const PositioningStandard* find_positioning_standard(std::string_view name);

/// Words and symbol of one figure of ISO 230-2, as the edition `same_as` words them: "deviation"
/// up to 2006, "error" since 2014 (names and the notation E_XX,A of 2014 are from memory).
struct FigureLabel {
    std::string symbol;      ///< "A↑"
    std::string name;        ///< "unidirectional accuracy of positioning, positive direction"
    std::string axis_symbol; ///< "E_XX,A↑"; since 2014, for an axis named by one letter; or empty
};

/// `key` is a parameter of the contract ("A_forward"); an unknown one gives empty words.
FigureLabel figure_label(std::string_view key, std::string_view same_as, std::string_view axis);

} // namespace axiscal
