#include "acquisition/documents/result_digest.hpp"

#include "acquisition/runfile/digest.hpp"
#include "analysis/circular/circular_certificate.hpp"
#include "analysis/positioning/positioning_certificate.hpp"

#include <vector>

namespace axiscal {

namespace {

std::string sha256_of(const std::vector<std::byte>& bytes) {
    return sha256_hex({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

} // namespace

std::string result_digest(const PositioningResult& result) {
    return sha256_of(canonical_bytes(result));
}

std::string result_digest(const CircularParameters& parameters) {
    return sha256_of(canonical_bytes(parameters));
}

} // namespace axiscal
