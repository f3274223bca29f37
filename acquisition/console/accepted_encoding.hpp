#pragma once
// Whether a client takes what gzip has packed (Accept-Encoding: RFC 9110, 12.5.3). Pure.

#include <string_view>

namespace axiscal {

/// By the weights that the client gives to both forms; packed is sent where they are equal.
/// @param field  of Accept-Encoding; several lines of it are joined by ", "
/// @returns false where the client names neither gzip nor `*`, and for what breaks the grammar:
/// whoever asks can read what is not packed
bool takes_gzip(std::string_view field);

} // namespace axiscal
