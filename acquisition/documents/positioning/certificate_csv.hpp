#pragma once
// certificate.csv: every deviation in one row, for spreadsheets. Pure.

#include "analysis/positioning/positioning_certificate.hpp"

#include <string>

namespace axiscal {

/// Head lines begin with '#', then comes one table. Line ends are CR LF (RFC 4180).
///   # axiscal.certificate-csv/1
///   # <key>,<value>             run, certificate_number, machine, machine_serial, axis, started,
///                               finished, standard, sign, run_file_sha256, software_version
///   # parameter,<key>,<value>,<unit>,± <U>,k = <k>        the contract's keys and result unit;
///                               "U not evaluated" instead of ± U where a term is not stated
///   # target_uncertainty,<key>,<U_T>,<unit>,met|not met   where one is stated
///   # not_evaluated,<key>,<reason>
///   # budget,<term>,<u>,<unit>,<formula>,<status>         standard uncertainties
///   # preliminary,not stated,<what>                       absent when the certificate is final
///   # synchronisation,<um>,um,largest of <n> captures; <m> not stated     or: not stated
///   run,direction,target_mm,measured_mm,deviation_um,t_air_degC,p_Pa,rh_percent,t_mat_degC,time,
///                               synchronisation_um
/// `run` counts the approaches from 1, `direction` is "forward" or "backward", `measured` is
/// target + deviation at 20 °C, `time` is UTC of the middle of the window,
/// `synchronisation_um` what the uncertain time of its samples adds. Rows stand in the order
/// of measuring. A rotary axis has target_deg, measured_deg, deviation_arcsec; one that an
/// autocollimator reads has synchronisation_arcsec, too, and "arcsec" in the head line. Numbers are
/// the shortest decimals that read back as the same double; what is not known is empty. Fields
/// with commas or quotes are quoted.
std::string certificate_csv(const Certificate& certificate);

} // namespace axiscal
