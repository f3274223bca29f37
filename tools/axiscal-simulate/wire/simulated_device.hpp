#pragma once
// What every wire face has: a thread of its own to run on, and a behaviour that the control channel
// may change. command() and status() are thread-safe.

#include "analysis/quantity/result.hpp"

#include <atomic>
#include <nlohmann/json.hpp>
#include <stop_token>
#include <string>

namespace axiscal::simulate {

enum class Behaviour { on, off, garbage, flood };

class SimulatedDevice {
public:
    explicit SimulatedDevice(std::string name)
        : name_{std::move(name)} {}
    virtual ~SimulatedDevice() = default;
    SimulatedDevice(const SimulatedDevice&) = delete;
    SimulatedDevice& operator=(const SimulatedDevice&) = delete;

    virtual void run(std::stop_token stop) = 0;
    /// Where a client finds it: {"path":...} or {"port":...}.
    [[nodiscard]] virtual nlohmann::json place() const = 0;
    [[nodiscard]] virtual nlohmann::json status() const { return place(); }
    [[nodiscard]] const std::string& name() const { return name_; }
    void behave(Behaviour behaviour) { behaviour_ = behaviour; }
    /// @errors bad_request for a word that is none of on, off, garbage, flood.
    Result<void> behave(const std::string& word);

protected:
    [[nodiscard]] Behaviour behaviour() const { return behaviour_; }

private:
    std::string name_;
    std::atomic<Behaviour> behaviour_{Behaviour::on};
};

/// Bytes without meaning, the same for the same seed and index.
std::string garbage_bytes(std::uint64_t seed, std::uint64_t index);

} // namespace axiscal::simulate
