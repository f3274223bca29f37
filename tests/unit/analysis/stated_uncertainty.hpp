#pragma once
// What a good workshop states of its measurement: nothing that the budget needs is left out.

#include "analysis/record/run_record.hpp"

namespace axiscal::test {

inline UncertaintySetup stated_uncertainty() {
    UncertaintySetup setup;
    setup.device_U.per_length = Ratio::from_si(0.7e-6);
    setup.misalignment = mm(1);
    setup.temperature_width = kelvin(0.7);
    setup.expansion_width = um_per_m_kelvin(2);
    setup.eve = um(1.7);
    return setup;
}

} // namespace axiscal::test
