#pragma once
// An ELCOMAT 3000 as its users' programs read it (docs/instruments/elcomat.md): the letter "a" asks
// for one absolute reading, the answer is "4", the state, both axes in seconds of arc, CR. Pure.

#include <optional>
#include <string>

namespace axiscal::simulate {

/// State 003: both axes are valid; 000 without light, where `x_arcsec` is empty.
std::string elcomat_record(std::optional<double> x_arcsec, double y_arcsec);

/// One record for each request in `typed`, which is emptied: CR and LF are passed over.
std::string elcomat_answer(std::string& typed, std::optional<double> x_arcsec, double y_arcsec);

} // namespace axiscal::simulate
