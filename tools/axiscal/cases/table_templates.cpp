// What `axiscal case new` writes.
#include "tools/axiscal/cases/case_table.hpp"

namespace axiscal {
namespace {

constexpr std::string_view positioning_template =
    R"(# Positioning, ISO 230-2. Write your readings over the example; 'axiscal analyze FILE' takes it as it is.
# Above the header "# key: value" states what a JSON case would: docs/analysis.md has the keys.
# standard: ISO 230-2:2014
# axis: X
# readings: deviations
# A column a reading: run1 + is the first approach in positive direction, run1 - in negative direction.
# Comma, semicolon or tab between cells; decimal point or comma; units in the header: mm, um, m, deg, arcsec.
target [mm],run1 + [um],run1 - [um],run2 + [um],run2 - [um],run3 + [um],run3 - [um],run4 + [um],run4 - [um],run5 + [um],run5 - [um]
0,0.0,-1.2,0.3,-1.0,0.1,-1.1,-0.2,-1.3,0.2,-0.9
250,1.1,-0.3,1.4,0.1,1.2,-0.2,0.9,-0.1,1.3,0.0
500,2.3,0.9,2.1,1.2,2.4,1.0,2.2,0.8,2.0,1.1
750,3.1,2.2,3.4,1.9,3.2,2.0,3.0,2.1,3.3,1.8
1000,4.2,2.9,4.0,3.1,4.1,3.0,4.3,2.8,3.9,3.2
)";

constexpr std::string_view circular_template =
    R"(# Circular test, ISO 230-4. Write your readings over the example; 'axiscal analyze FILE' takes it as it is.
# Angles from the first + axis, counter-clockwise positive for both senses; deviation = measured - nominal radius.
# nominal_radius_mm: 100
# feed_mm_per_min: 1000
angle [deg],ccw [um],cw [um]
0,1.2,0.8
30,1.9,1.1
60,2.3,1.7
90,2.0,1.6
120,1.1,0.9
150,0.2,-0.1
180,-0.9,-0.8
210,-1.8,-1.5
240,-2.1,-1.7
270,-1.7,-1.2
300,-0.6,-0.4
330,0.4,0.3
)";

constexpr std::string_view workpiece_template =
    R"(# Both measurements of a workpiece: on the machine and on a CMM, in mm. 'axiscal analyze FILE' takes it as it is.
feature,nominal_x,nominal_y,on_machine_y,cmm_y
slot 1,-20,40,40.001,40.004
slot 1,20,40,40.002,40.001
slot 2,-20,80,80.003,80.002
slot 2,20,80,80.001,80.005
)";

} // namespace

std::string table_template(std::string_view kind) {
    if (kind == "positioning") return std::string{positioning_template};
    if (kind == "circular") return std::string{circular_template};
    if (kind == "workpiece") return std::string{workpiece_template};
    return "";
}

} // namespace axiscal
