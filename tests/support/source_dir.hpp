#pragma once

#include <string>

namespace axiscal::test {

/// The folder of the checkout. A function, not a macro: only one file depends on where the checkout
/// lies, and a compiler cache serves every other one.
std::string source_dir();

} // namespace axiscal::test
