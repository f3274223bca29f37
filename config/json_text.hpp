#pragma once
// The one way from JSON to its text: what is no UTF-8 in it becomes U+FFFD. nlohmann's own default
// throws, and what is thrown for one byte of a stranger ends a daemon. Pure.

#include <nlohmann/json.hpp>

#include <string>

namespace axiscal {

/// On one line, or indented by `indent`.
template <class Json> std::string json_text(const Json& json, int indent = -1) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

} // namespace axiscal
