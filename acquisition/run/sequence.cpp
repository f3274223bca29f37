#include "acquisition/run/sequence.hpp"

namespace axiscal {
namespace {

constexpr int cycle = last_sequence; // numbers in use: 1..65534

std::string between(std::uint16_t first, std::uint16_t last) {
    if (first == last) return "request " + std::to_string(first) + " was missed";
    return "requests " + std::to_string(first) + " to " + std::to_string(last) + " were missed";
}

} // namespace

std::string describe_disorder(std::uint16_t came, std::uint16_t last_durable) {
    const auto expected = next_sequence(last_durable);
    const std::string request = "Request " + std::to_string(came);
    const std::string awaited = "request " + std::to_string(expected) + " is awaited";
    if (came == no_run_sequence)
        return request + " is no number of a request, which run from 1 to " +
               std::to_string(last_sequence) + "; " + awaited + ".";
    if (came == 0) return "The CNC went back to idle (0) while " + awaited + ".";
    if (came == 1 && last_durable > 1)
        return request + " came, but " + awaited +
               ": the CNC's counter was restarted; abort this run and arm a new one.";
    const int ahead = (came - expected + cycle) % cycle;
    if (ahead < cycle / 2) {
        const auto before = came == 1 ? last_sequence : static_cast<std::uint16_t>(came - 1);
        return request + " came, but " + awaited + ": " + between(expected, before) + ".";
    }
    return request + " came late: it was finished before, " + awaited +
           " (last durable: " + std::to_string(last_durable) + ").";
}

} // namespace axiscal
