#include "wire/simulated_ids.hpp"

#include "wire/client_poll.hpp"

#include <arpa/inet.h>
#include <cerrno>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace axiscal::simulate {

namespace {

/// Noise is a function of the sample's number: a millisecond each.
constexpr double samples_per_s = 1000;

} // namespace

SimulatedIds::SimulatedIds(const Scenario& scenario,
                           SimClock clock,
                           std::function<double(double)> drive,
                           int listener,
                           int port)
    : SimulatedDevice{"laser"}
    , scenario_{scenario}
    , clock_{clock}
    , drive_{std::move(drive)}
    , machine_{scenario}
    , beam_angle_rad_{scenario.laser.beam_tilt_mrad * 1e-3}
    , listener_{listener}
    , port_{port} {
    device_.compensation_mode = scenario.laser.device_corrects ? 0 : 2;
}

SimulatedIds::~SimulatedIds() {
    for (const auto& [socket, pending] : clients_)
        ::close(socket);
    ::close(listener_);
}

Result<std::unique_ptr<SimulatedIds>>
SimulatedIds::open(const Scenario& scenario, SimClock clock, std::function<double(double)> drive) {
    const int listener = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    const int yes = 1;
    ::setsockopt(listener, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(scenario.laser.port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* plain = reinterpret_cast<sockaddr*>(&address);
    if (listener < 0 || ::bind(listener, plain, size) != 0 || ::listen(listener, 4) != 0 ||
        ::getsockname(listener, plain, &size) != 0) {
        const std::error_code cause{errno, std::generic_category()};
        if (listener >= 0) ::close(listener);
        return fail(Fault::io, "the IDS can not listen on 127.0.0.1", cause);
    }
    return std::unique_ptr<SimulatedIds>{
        new SimulatedIds{scenario, clock, std::move(drive), listener, ntohs(address.sin_port)}};
}

IdsReading SimulatedIds::read_now() {
    const LaserScenario& laser = scenario_.laser;
    const double seconds = clock_.now_s();
    const auto sample = static_cast<std::uint64_t>(seconds * samples_per_s);
    const double slide_mm = machine_.slide_mm(drive_(seconds), seconds, sample);
    machine_.steer(beam_angle_rad_);
    const double cycles = machine_.cycles(slide_mm, seconds);
    const TrueAir air = air_at(scenario_.air, seconds);
    IdsReading now;
    now.vacuum_mm.fill(cycles * laser.wavelength_nm * 1e-6 / laser.fold);
    now.temperature_degC = air.temperature.in_celsius();
    now.pressure_hPa = air.pressure.in(hectopascal);
    now.humidity_percent = air.humidity.in(percent);
    now.index = 1 + refractivity(air, nm(laser.wavelength_nm));
    now.contrast_percent = machine_.contrast_percent(slide_mm);
    return now;
}

/// False: the client is gone.
bool SimulatedIds::serve(int socket, std::string& pending) {
    char chunk[2048];
    const ssize_t n = ::recv(socket, chunk, sizeof chunk, 0);
    if (n == 0 || (n < 0 && errno != EAGAIN)) return false;
    if (n > 0) pending.append(chunk, static_cast<std::size_t>(n));
    for (const std::string& request : take_requests(pending)) {
        std::string reply = device_.answer(request, read_now());
        ++answers_;
        if (behaviour() == Behaviour::off) continue;
        if (behaviour() == Behaviour::garbage) reply = garbage_bytes(scenario_.seed, answers_);
        if (::send(socket, reply.data(), reply.size(), MSG_NOSIGNAL) < 0) return false;
    }
    return true;
}

void SimulatedIds::run(std::stop_token stop) {
    while (!stop.stop_requested()) {
        std::vector<pollfd> waits{{listener_, POLLIN, 0}};
        for (const auto& [socket, pending] : clients_)
            waits.push_back({socket, POLLIN, 0});
        ::poll(waits.data(), waits.size(), client_poll_ms);
        if (waits[0].revents != 0)
            if (const int socket =
                    ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
                socket >= 0)
                clients_.try_emplace(socket);
        for (std::size_t i = 1; i < waits.size(); ++i)
            if (waits[i].revents != 0 && !serve(waits[i].fd, clients_[waits[i].fd])) {
                ::close(waits[i].fd);
                clients_.erase(waits[i].fd);
            }
    }
}

} // namespace axiscal::simulate
