#pragma once
// Axis Y across X through an optical square, with the readings of straightness_run.hpp; the line of
// X, and both lines with the square turned, as they were kept. What it comes to is computed by
// squareness_numbers.py.

#include "straightness_run.hpp"

#include <string>
#include <utility>
#include <vector>

namespace axiscal::test {

inline RecordedLine kept_line(std::string run_id,
                              std::string axis,
                              std::string across,
                              double interval_mm,
                              const std::vector<std::pair<double, double>>& means_um) {
    RecordedLine line{std::move(run_id), std::move(axis), std::move(across), 2, um(0.1), {}};
    for (const auto& [forward_um, backward_um] : means_um)
        line.rows.push_back({mm(interval_mm * static_cast<double>(line.rows.size())),
                             um(forward_um), um(backward_um)});
    return line;
}

/// X in the direction of Y: 15.333 um/m.
inline RecordedLine first_line() {
    return kept_line("station-20251231T010000Z-X", "X", "Y", 150,
                     {{0, -1}, {2, 1}, {3, 4}, {7, 6}});
}

/// 4.267 um/m and -4.4 um/m.
inline OtherSquare turned_square() {
    return {kept_line("station-20251231T020000Z-X", "X", "Y", 150,
                      {{0, -0.4}, {1, 0.6}, {0.4, 0.8}, {2.2, 1.8}}),
            kept_line("station-20251231T030000Z-Y", "Y", "X", 100,
                      {{0, 0.2}, {2, 1.6}, {3, 2.6}, {1.4, 1}, {-1.6, -2}})};
}

/// Everything is stated that a budget needs.
inline SquarenessSetup square_setup() {
    SquarenessSetup setup;
    setup.optics = bow_setup();
    setup.optics.across = "X";
    setup.first = first_line();
    setup.stated.error = arcsec(2);
    setup.stated.error_U = arcsec(1);
    setup.stated.mount_limit = arcsec(0.5);
    return setup;
}

/// As it is read from a closed run file.
inline RunFileContents square_contents(const SquarenessSetup& setup = square_setup()) {
    RunFileContents contents = bow_contents(setup.optics);
    contents.run.kind = TestKind::squareness;
    contents.run.run_id = "station-20260101T010000Z-Y";
    contents.run.statements.axis = "Y";
    contents.attachments.setup = setup;
    return contents;
}

} // namespace axiscal::test
