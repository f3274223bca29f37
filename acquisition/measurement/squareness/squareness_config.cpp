// [squareness] of the station file.
#include "acquisition/measurement/squareness/squareness_config.hpp"

#include "acquisition/measurement/straightness/straightness_config.hpp"

#include <algorithm>

namespace axiscal {
namespace {

/// Beyond what optics stand before a laser with, whatever their certificate says.
constexpr Angle largest_of_square = degree(1);

/// What was refused of [straightness] is told there: nothing of this table counts then.
bool is_measured_by_square(Settings& section, const StationConfig& station) {
    if (straightness_config_of(station) != nullptr) return true;
    if (std::ranges::find(station.kind_sections, TestKind::straightness, &KindSection::kind) ==
        station.kind_sections.end())
        section.refuse("", "needs the table [straightness] beside it, which states prism, mirror "
                           "and targets of this axis: add it (docs/straightness.md)");
    return false;
}

/// Each of the two runs is found by the letter of its axis, and the certificate names both by it.
void check_letter(Settings& section, const StationConfig& station) {
    const std::string& stated = station.statements.axis;
    const std::string& name = stated.empty() ? station.axis.name : stated;
    if (name == station.axis.program_axis) return;
    section.refuse("", "needs an axis that is called by its letter, and this one is called \"" +
                           name + "\": write axis.name = \"" + station.axis.program_axis +
                           "\" in the station file of either axis");
}

void read_earlier_runs(Settings& section, SquarenessConfig& config) {
    config.first = section.text("first", config.first);
    if (config.first.empty() && !section.refused("first"))
        section.refuse("first", "names the straightness run of the other axis: say \"latest\", or "
                                "its run id");
    config.reversal_of = section.text("reversal_of", "");
    if (section.choice("square", {"normal", "turned"}, "normal") == "turned")
        config.square = SquarePosition::turned;
}

/// A limit stands by itself; an uncertainty is that of an error that somebody found.
void read_error_of_square(Settings& section, SquareStatement& stated) {
    constexpr double least_k = 1, largest_k = 5;
    const Angle none;
    const Angle error = section.angle("square_error", -largest_of_square, largest_of_square, none);
    if (section.has("square_error")) stated.error = error;
    refuse_beside(section, "square_uncertainty", "square_limit");
    const Angle expanded = section.angle("square_uncertainty", none, largest_of_square, none);
    if (section.has("square_uncertainty")) {
        stated.error_U = expanded;
        if (!section.has("square_error"))
            section.refuse("square_uncertainty", "is that of square_error: state that one too, "
                                                 "from the certificate of the square");
    }
    const Angle limit = section.angle("square_limit", none, largest_of_square, none);
    if (section.has("square_limit")) stated.error_limit = limit;
    stated.error_k = section.number("square_k", least_k, largest_k, stated.error_k);
    if (section.has("square_k") && !section.has("square_uncertainty"))
        section.refuse("square_k", "belongs to square_uncertainty: state that one too");
}

void read_mount(Settings& section, SquareStatement& stated) {
    const Angle none, limit = section.angle("mount_limit", none, largest_of_square, none);
    if (section.has("mount_limit")) stated.mount_limit = limit;
}

void read_artefact(Settings artefact, InstrumentRecord& record) {
    record.name = "optical square";
    record.maker = artefact.text("maker", "");
    record.model = artefact.text("model", "");
    record.serial = artefact.text("serial", "");
    read_certificate_dates(artefact, record);
}

} // namespace

std::any read_squareness_section(Settings section, const StationConfig& station) {
    if (!is_measured_by_square(section, station)) {
        section.accept_rest();
        return {};
    }
    SquarenessConfig config;
    check_letter(section, station);
    read_earlier_runs(section, config);
    read_error_of_square(section, config.stated);
    read_mount(section, config.stated);
    read_artefact(section.table("optical_square"), config.artefact);
    return config;
}

} // namespace axiscal
