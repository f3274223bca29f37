#pragma once
// A station that measures two axes one after the other, the second through an optical square.

#include "acquisition/measurement/squareness/squareness_config.hpp"
#include "tests/unit/station/straightness_bench.hpp"

#include <map>
#include <string>
#include <utility>

namespace axiscal::testing {

/// The lines are straight: X rises by 20 um/m towards Y, Y falls by 50 um/m.
class SquarenessShop : public StraightnessShop {
public:
    SquarenessShop() { look_at_x(); }
    /// The station file of the first axis.
    void look_at_x(const std::string& keys = "across = \"Y\"\nsign = 1\nfactor = 36\n") {
        name_axis("X");
        deviation_um = [](double x_mm) { return 0.02 * x_mm; };
        state_table(keys);
    }
    /// That of the second one, whose [squareness] has these keys.
    void look_at_y(const std::string& square_keys = "",
                   const std::string& keys = "across = \"X\"\nsign = 1\nfactor = 36\n") {
        name_axis("Y");
        deviation_um = [](double y_mm) { return -0.05 * y_mm; };
        state_table(keys);
        auto document =
            SettingsDocument::parse("[squareness]\n" + square_keys, "station.toml").value();
        Settings table = document.root().table("squareness");
        KindSection section{TestKind::squareness, table, read_squareness_section(table, config)};
        EXPECT_TRUE(document.finish().empty()) << square_keys;
        config.kind_sections.push_back(std::move(section));
    }
    [[nodiscard]] std::vector<RunFileContents> runs_of(TestKind kind) const {
        std::vector<RunFileContents> runs;
        for (const RunSummary& run : list_run_files(scratch.file("runs")))
            if (run.kind == kind) runs.push_back(read_run_file_contents(run.path).value());
        return runs;
    }

private:
    void name_axis(const std::string& letter) {
        config.axis.name = config.axis.program_axis = letter;
        now += 20s;
    }
};

/// @param options  of this kind
inline ArmRequest order_of_squareness(std::map<std::string, std::string> options = {}) {
    ArmRequest request;
    request.kind = TestKind::squareness;
    request.pass = "squareness";
    request.options = std::move(options);
    return request;
}

} // namespace axiscal::testing
