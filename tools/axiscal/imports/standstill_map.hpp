#pragma once
// What a map says of captures that no trigger marked, and of the µMD's log (docs/import.md).

#include "config/settings.hpp"
#include "tools/axiscal/imports/import_map.hpp"

namespace axiscal {

/// The table [standstill]. Refusals are collected in `table`.
StandstillMap standstill_map(Settings table, AxisKind kind);

/// The tables [counts] and [standstill] of a map of kind "umd".
UmdMap umd_map(Settings root, AxisKind kind);

} // namespace axiscal
