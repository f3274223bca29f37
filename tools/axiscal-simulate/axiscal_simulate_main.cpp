// axiscal-simulate: the simulated machine with its instruments and its CNC.

#include "control_socket.hpp"
#include "simulator.hpp"
#include "tools/describe/describe.hpp"
#include "truth.hpp"
#include "wire/can/can_bus.hpp"
#include "wire/usb/usb_hub.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <iostream>
#include <system_error>
#include <unistd.h>

namespace {

using namespace axiscal;
using namespace axiscal::simulate;

/// Exit codes: 1 the world can not be opened, 3 the scenario or the program is refused.
constexpr int can_not_open = 1, is_refused = 3;

struct Options {
    std::string scenario, program, truth, control, positions, interface = "can0";
    std::vector<double> targets;
    std::vector<std::string> devices;
    StreamFields fields;
    int approaches = 5, cnc_port = -1, first_port = 0;
    bool run = false, one_way = false;
};

int complain(const Error& error, int code) {
    std::cerr << "axiscal-simulate: " << describe(error) << "\n";
    return code;
}

volatile std::sig_atomic_t asked_to_end = 0;
void on_signal(int) {
    asked_to_end = 1;
}

Result<TruthPlan> plan_of(const Options& options, const Scenario& scenario) {
    if (!options.targets.empty()) {
        auto targets = options.targets;
        std::sort(targets.begin(), targets.end());
        return TruthPlan{targets, options.approaches, !options.one_way};
    }
    AXISCAL_TRY(const std::string text, read_program(options.program));
    return plan_of_program(text, is_marlin(options.program), scenario);
}

int print_truth(const Options& options) {
    const auto scenario = read_scenario(options.scenario);
    if (!scenario) return complain(scenario.error(), is_refused);
    const auto plan = plan_of(options, *scenario);
    if (!plan) return complain(plan.error(), is_refused);
    const std::string text = truth_of(*scenario, *plan).dump(1) + "\n";
    if (options.truth.empty()) {
        if (std::cout << text << std::flush) return 0;
        std::cerr << "axiscal-simulate: could not write all of its output to standard output: "
                  << std::generic_category().message(errno) << "\n";
        return can_not_open;
    }
    std::ofstream file{options.truth};
    file << text;
    return file.flush() ? 0 : can_not_open;
}

/// Answers the control channel on a thread of its own until the returned thread is stopped.
template <typename World>
Result<std::jthread> answer_commands(const std::string& path, World& world) {
    if (path.empty()) return std::jthread{};
    AXISCAL_TRY(ControlSocket socket, ControlSocket::listen(path));
    return std::jthread{[&world, s = std::move(socket)](const std::stop_token& stop) {
        s.serve(stop, [&](const std::string& line) { return world.command(line).dump(); });
    }};
}

/// Lives until quit, a signal, or an error of the start.
int live(const Options& options, Simulator& world) {
    world.start(!options.positions.empty());
    const auto control = answer_commands(options.control, world);
    if (!control) return complain(control.error(), can_not_open);
    nlohmann::json ready = world.places();
    if (!options.control.empty()) ready["control"] = options.control;
    std::cout << ready.dump() << '\n' << std::flush;
    if (options.run) {
        const auto answer = world.command("run");
        if (!answer["ok"].get<bool>()) return std::cerr << answer.dump() << "\n", is_refused;
    }
    if (!options.positions.empty()) {
        const bool standard = options.positions == "-";
        const int stream = standard ? STDIN_FILENO : ::open(options.positions.c_str(), O_RDONLY);
        if (stream >= 0) world.feed_positions(stream, options.fields);
        if (stream > STDIN_FILENO) ::close(stream);
    }
    while (!world.ended() && asked_to_end == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds{50});
    return 0;
}

/// A real CNC's position stream: it speaks for itself, and each of its lines is a sample of laser
/// and ballbar.
void let_another_drive(Scenario& scenario) {
    constexpr double stream_hz = 1000; // LinuxCNC's servo cycle
    scenario.cnc.reset();
    scenario.laser.rate_hz = stream_hz;
    if (scenario.ballbar) scenario.ballbar->rate_hz = stream_hz;
}

int open_and_live(const Options& options) {
    auto scenario = read_scenario(options.scenario);
    if (!scenario) return complain(scenario.error(), is_refused);
    if (options.cnc_port >= 0 && scenario->cnc) scenario->cnc->port = options.cnc_port;
    if (!options.positions.empty()) let_another_drive(*scenario);
    auto world = Simulator::open(*scenario);
    if (!world) return complain(world.error(), can_not_open);
    (*world)->set_program(options.program);
    if (!options.truth.empty()) {
        auto written = (*world)->write_truth(options.truth);
        if (!written) return complain(written.error(), is_refused);
    }
    return live(options, **world);
}

/// The devices stay plugged in until quit or a signal.
int plug_usb(const Options& options) {
    auto scenario = read_scenario(options.scenario);
    if (!scenario) return complain(scenario.error(), is_refused);
    auto hub = UsbHub::open(options.devices, {*scenario, SimClock{}}, options.first_port);
    if (!hub) return complain(hub.error(), can_not_open);
    const std::string ready = (*hub)->status().dump();
    const auto control = answer_commands(options.control, **hub);
    if (!control) return complain(control.error(), can_not_open);
    std::cout << ready << '\n' << std::flush;
    while (!(*hub)->ended() && asked_to_end == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds{50});
    return 0;
}

/// The devices stay on the bus until quit or a signal.
int join_can(const Options& options) {
    auto scenario = read_scenario(options.scenario);
    if (!scenario) return complain(scenario.error(), is_refused);
    auto bus = CanBus::open(options.interface, options.devices, {*scenario, SimClock{}});
    if (!bus) return complain(bus.error(), can_not_open);
    const std::string ready = (*bus)->status().dump();
    const auto control = answer_commands(options.control, **bus);
    if (!control) return complain(control.error(), can_not_open);
    std::cout << ready << '\n' << std::flush;
    while (!(*bus)->ended() && asked_to_end == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds{50});
    return 0;
}

int run(int argc, char** argv) {
    std::signal(SIGPIPE, SIG_IGN);
    struct sigaction action {};
    action.sa_handler = on_signal; // no SA_RESTART: a wait for positions ends too
    sigaction(SIGTERM, &action, nullptr);
    sigaction(SIGINT, &action, nullptr);

    Options options;
    CLI::App app{"A machine with hidden errors, its instruments on the wire and its CNC.",
                 "axiscal-simulate"};
    app.set_version_flag("--version", AXISCAL_VERSION);
    describe_on_request(app);
    app.add_option("--scenario", options.scenario, "scenario file, .toml or .json");
    app.add_option("--program", options.program, "part program (.gcode: Marlin, else LinuxCNC)");
    app.add_option("--truth", options.truth, "write the hidden truth of the program here");
    app.add_option("--control", options.control, "Unix socket for commands");
    app.add_option("--positions", options.positions,
                   "drive laser and ballbar from a 1 kHz stream (the scenario's [cnc] rests); - is "
                   "stdin");
    app.add_option("--positions-field", options.fields.laser,
                   "which value of a line is the laser's axis, from 1");
    app.add_option("--table-field", options.fields.table,
                   "which value of a line is the position of the indexing table; 0: none");
    app.add_option("--cnc-port", options.cnc_port, "the daemon's Modbus TCP port");
    app.add_flag("--run", options.run, "run the program at once");
    CLI::App* truth = app.add_subcommand("truth", "only compute the truth");
    truth->fallthrough();
    truth->add_option("--targets", options.targets, "targets in mm")->delimiter(',');
    truth->add_option("--approaches", options.approaches, "n in each direction");
    truth->add_flag("--one-way", options.one_way, "forward approaches only");
    CLI::App* usb = app.add_subcommand("usb", "plug USB devices into the kernel's vhci_hcd; root");
    usb->fallthrough();
    usb->add_option("--device", options.devices, "KIND,name=value,... (README.md)")->required();
    usb->add_option("--first-port", options.first_port, "socket of the first device, 0 to 7");
    CLI::App* can = app.add_subcommand("can", "CANopen devices on a CAN interface");
    can->fallthrough();
    can->add_option("--device", options.devices, "KIND,name=value,... (README.md)")->required();
    can->add_option("--interface", options.interface, "as `ip link` names it");
    CLI11_PARSE(app, argc, argv);
    if (options.scenario.empty()) {
        std::cerr << "axiscal-simulate: --scenario FILE is missing\n";
        return is_refused;
    }
    if (usb->parsed()) return plug_usb(options);
    if (can->parsed()) return join_can(options);
    return truth->parsed() ? print_truth(options) : open_and_live(options);
}

} // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& bug) {
        std::fprintf(stderr, "axiscal-simulate: %s\n", bug.what());
        return can_not_open;
    }
}
