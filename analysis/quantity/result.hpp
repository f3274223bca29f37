#pragma once
// What can fail says so in its signature. `Fault` is the one closed list of what can go wrong:
// each has the sentence the technician reads and the RESULT code the CNC sees.

#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>
#include <tl/expected.hpp>
#include <utility>

namespace axiscal {

enum class Fault : std::uint8_t {
    none,
    // RESULT codes 1..12 of the sequence-block (docs/trigger.md)
    beam_lost,
    not_still,
    outside_window,
    environment_stale,
    bad_command,
    overspeed,
    not_durable,
    datum_lost,
    wrong_target,
    wrong_direction,
    out_of_order,
    no_run_armed,
    // instruments and links
    link_closed,
    link_timeout,
    bad_frame,
    checksum,
    signal_error,
    implausible_jump,
    samples_lost,
    unknown_instrument,
    wrong_medium,
    stale,
    environment_outside,
    // files, requests, configuration, data
    bad_configuration,
    bad_request,
    bad_case,
    bad_run_file,
    incomplete_run,
    sequence_lost,
    busy,
    refused,
    not_found,
    io,
    internal,
};

struct Error {
    Fault fault = Fault::internal;
    std::string detail;         ///< names the thing, the place and the way out
    std::error_code cause = {}; ///< the system's own word, if any
    std::string field = {};     ///< the refused field, where there is one ("forward[3][1]")
};

template <class T> using Result = tl::expected<T, Error>;

inline tl::unexpected<Error> fail(Fault fault, std::string detail, std::error_code cause = {}) {
    return tl::unexpected<Error>(Error{fault, std::move(detail), cause, {}});
}
inline tl::unexpected<Error> refuse(Fault fault, std::string field, std::string reason) {
    return tl::unexpected<Error>(Error{fault, std::move(reason), {}, std::move(field)});
}

/// Stable name ("beam_lost"): API, run file, JSON.
std::string_view fault_name(Fault fault);
/// One sentence for the technician: what is seen and what to do next.
std::string_view fault_sentence(Fault fault);
/// RESULT word of the sequence-block: 0 ok, 1..12; 5 (bad command) for faults the CNC cannot tell
/// apart.
std::uint16_t cnc_result_code(Fault fault);
/// Inverse of fault_name; Fault::internal for an unknown name.
Fault fault_from_name(std::string_view name);
/// "sentence [field] detail (cause)"; of Fault::io and none the sentence only where no detail is.
std::string describe(const Error& error);

} // namespace axiscal

#define AXISCAL_JOIN2(a, b) a##b
#define AXISCAL_JOIN(a, b) AXISCAL_JOIN2(a, b)
/// AXISCAL_TRY(auto value, expression): unwraps or returns the error to the caller.
#define AXISCAL_TRY(declaration, expression)                                                       \
    AXISCAL_TRY_AS(AXISCAL_JOIN(try_result_, __LINE__), declaration, expression)
#define AXISCAL_TRY_AS(name, declaration, expression)                                              \
    auto name = (expression);                                                                      \
    if (!name) return tl::unexpected<::axiscal::Error>(std::move(name).error());                   \
    declaration = *std::move(name)
/// The same inside a coroutine.
#define AXISCAL_CO_TRY(declaration, expression)                                                    \
    AXISCAL_CO_TRY_AS(AXISCAL_JOIN(try_result_, __LINE__), declaration, expression)
#define AXISCAL_CO_TRY_AS(name, declaration, expression)                                           \
    auto name = (expression);                                                                      \
    if (!name) co_return tl::unexpected<::axiscal::Error>(std::move(name).error());                \
    declaration = *std::move(name)
/// AXISCAL_CHECK(expression): returns the error of a Result<void> to the caller.
#define AXISCAL_CHECK(expression)                                                                  \
    do {                                                                                           \
        if (auto checked = (expression); !checked)                                                 \
            return tl::unexpected<::axiscal::Error>(std::move(checked).error());                   \
    } while (false)
