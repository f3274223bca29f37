#include "acquisition/publish/destination.hpp"

namespace axiscal {
namespace {

constexpr const char* whole_share = "share"; // Error::field

} // namespace

tl::unexpected<Error> share_lost(std::string detail, int error) {
    return tl::unexpected<Error>(Error{Fault::io, std::move(detail),
                                       std::error_code{error, std::generic_category()},
                                       whole_share});
}

bool is_share_lost(const Error& error) {
    return error.fault == Fault::io && error.field == whole_share;
}

std::string publishing_text(const Error& error) {
    if (!is_share_lost(error)) return describe(error);
    return error.cause ? error.detail + " (" + error.cause.message() + ")" : error.detail;
}

} // namespace axiscal
