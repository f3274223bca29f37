#include "simulator.hpp"

#include "truth.hpp"
#include "wire/simulated_sensors.hpp"

#include <filesystem>
#include <fstream>
#include <poll.h>
#include <sstream>
#include <unistd.h>

namespace axiscal::simulate {

namespace {
PlanePoint start_of(const Scenario& scenario) {
    const BallbarScenario bar = scenario.ballbar.value_or(BallbarScenario{});
    return {bar.start_first_mm, bar.start_second_mm};
}
} // namespace

Simulator::Simulator(const Scenario& scenario)
    : scenario_{scenario}
    , axis_{scenario.axis.start_mm, scenario.axis.acceleration_mm_per_s2}
    , table_{0, scenario.axis.acceleration_mm_per_s2}
    , plane_{start_of(scenario), scenario.axis.acceleration_mm_per_s2}
    , lines_{scenario.cnc.value_or(CncScenario{})} {}

Simulator::~Simulator() {
    for (auto& thread : threads_)
        thread.request_stop();
    if (runner_) runner_->stop();
}

Result<std::unique_ptr<Simulator>> Simulator::open(const Scenario& scenario) {
    std::unique_ptr<Simulator> simulator{new Simulator{scenario}};
    auto opened = simulator->open_faces();
    if (!opened) return tl::unexpected<Error>(opened.error());
    return simulator;
}

Result<void> Simulator::open_faces() {
    const auto drive = [this](double seconds) { return axis_.position_mm(seconds); };
    if (scenario_.laser.kind == "ids3010") {
        AXISCAL_TRY(auto face, SimulatedIds::open(scenario_, clock_, drive));
        ids_ = face.get();
        sensors_.push_back(std::move(face));
    } else if (scenario_.laser.kind == "hpi-3d") {
        AXISCAL_TRY(Pty pty, Pty::open(scenario_.laser.path));
        auto face = std::make_unique<SimulatedHpi>(scenario_, std::move(pty), clock_, drive);
        hpi_ = face.get();
        sensors_.push_back(std::move(face));
    } else if (!scenario_.laser.path.empty()) {
        AXISCAL_TRY(Pty pty, Pty::open(scenario_.laser.path));
        const auto table = [this](double seconds) { return table_.position_mm(seconds); };
        laser_ = std::make_unique<SimulatedLaser>(scenario_, std::move(pty), clock_, drive, table);
    }
    const auto slide = [this] { return laser_ ? laser_->slide_mm() : 0.0; };
    for (const SensorScenario& sensor : scenario_.sensors) {
        AXISCAL_TRY(auto face, open_simulated_sensor(scenario_, sensor, clock_, slide));
        sensors_.push_back(std::move(face));
    }
    if (scenario_.ballbar) {
        AXISCAL_TRY(Pty pty, Pty::open(scenario_.ballbar->path));
        auto bar = std::make_unique<SimulatedBar>(scenario_, std::move(pty), clock_, plane_);
        bar_ = bar.get();
        sensors_.push_back(std::move(bar));
    }
    if (!scenario_.cnc) return {};
    runner_ = std::make_unique<CncRunner>(scenario_, axis_, plane_, lines_, clock_, &table_);
    if (scenario_.cnc->shape == "dwell") return {};
    if (scenario_.cnc->transport == "server") {
        AXISCAL_TRY(exchange_, CncServer::open(*scenario_.cnc, lines_, clock_));
        return {};
    }
    CncScenario cnc = *scenario_.cnc;
    if (cnc.transport == "rtu" && !std::filesystem::is_character_file(cnc.path)) {
        AXISCAL_TRY(cable_, SerialCable::open(cnc.path, cnc.path + ".cnc"));
        cnc.path += ".cnc";
    }
    auto client = std::make_unique<CncClient>(cnc, lines_, clock_);
    client_ = client.get();
    exchange_ = std::move(client);
    return {};
}

void Simulator::start(bool external_positions) {
    if (laser_ && !external_positions)
        threads_.emplace_back([this](const std::stop_token& stop) { laser_->run(stop); });
    for (const auto& sensor : sensors_) {
        if (sensor.get() == bar_ && external_positions) continue;
        threads_.emplace_back(
            [face = sensor.get()](const std::stop_token& stop) { face->run(stop); });
    }
    if (cable_) threads_.emplace_back([this](const std::stop_token& stop) { cable_->run(stop); });
    if (exchange_)
        threads_.emplace_back([this](const std::stop_token& stop) { exchange_->run(stop); });
}

std::string Simulator::feed_lines(const std::string& text, StreamFields fields) {
    std::size_t begin = 0;
    for (auto end = text.find('\n'); end != std::string::npos; end = text.find('\n', begin)) {
        std::istringstream line{text.substr(begin, end - begin)};
        begin = end + 1;
        double number = 0, value = 0;
        line >> number; // the CNC's own count of servo cycles
        std::vector<double> values;
        while (line >> value)
            values.push_back(value);
        feed_faces(values, fields); // "overrun" and the like are no samples
    }
    return text.substr(begin);
}

void Simulator::feed_faces(const std::vector<double>& values, StreamFields fields) {
    constexpr std::size_t axes = 3; // X, Y, Z come first
    const auto of_laser = static_cast<std::size_t>(fields.laser) - 1;
    const auto of_table = static_cast<std::size_t>(fields.table) - 1; // 0: beyond every line
    if (of_table < values.size()) feed_table(values[of_table]);
    if (laser_ && of_laser < values.size()) laser_->feed(values[of_laser]);
    if (bar_ == nullptr || values.size() < axes) return;
    const auto drive_mm = [&](std::size_t which) {
        return values[static_cast<std::size_t>(scenario_.ballbar->plane[which] - 'X')];
    };
    bar_->feed({drive_mm(0), drive_mm(1)});
}

/// The table turns in the time of the stream, which is that of the laser's records.
void Simulator::feed_table(double position) {
    if (!laser_ || !scenario_.indexing_table || position == told_position_) return;
    told_position_ = position;
    const TableScenario& table = *scenario_.indexing_table;
    table_.move(laser_->next_s(), position * table.step_deg, table.turn_deg_per_s);
}

void Simulator::feed_positions(int descriptor, StreamFields fields) {
    std::string rest;
    char chunk[4096];
    while (!ended_) {
        pollfd wait{descriptor, POLLIN, 0};
        const int ready = ::poll(&wait, 1, 50);
        if (ready < 0) return; // a signal: the caller decides
        if (ready == 0) continue;
        const ssize_t n = ::read(descriptor, chunk, sizeof chunk);
        if (n <= 0) return;
        rest = feed_lines(rest.append(chunk, static_cast<std::size_t>(n)), fields);
    }
}

Result<void> Simulator::write_truth(const std::string& path) {
    AXISCAL_TRY(const std::string text, read_program(program_));
    AXISCAL_TRY(const TruthPlan plan, plan_of_program(text, is_marlin(program_), scenario_));
    std::ofstream file{path};
    file << truth_of(scenario_, plan).dump(1) << "\n";
    if (!file.flush()) return fail(Fault::io, "the truth can not be written to " + path);
    return {};
}

nlohmann::json Simulator::places() const {
    nlohmann::json places{{"ready", true}};
    if (laser_) places["laser"] = laser_->place();
    for (const auto& sensor : sensors_)
        places["sensors"][sensor->name()] = sensor->place();
    if (exchange_) places["cnc"] = {{"port", exchange_->port()}};
    if (cable_) places["cnc"] = {{"path", scenario_.cnc->path}};
    return places;
}

nlohmann::json Simulator::status() const {
    nlohmann::json status = runner_ ? runner_->status() : nlohmann::json::object();
    if (laser_) status["laser"] = laser_->status();
    if (bar_ != nullptr) status["ballbar"] = bar_->status();
    if (exchange_) status["connected"] = exchange_->connected();
    return status;
}

Result<void> Simulator::obey_hpi(const std::string& word, const std::string& state) {
    if (word == "beam") return hpi_->set_beam(state == "on"), Result<void>{};
    if (word == "restart-counter") return hpi_->restart(), Result<void>{};
    return fail(Fault::bad_request, "an HPI-3D has no \"" + word + "\"");
}

Result<void> Simulator::obey_laser(const std::string& word, std::istream& arguments) {
    if (!laser_ && hpi_ == nullptr) return fail(Fault::not_found, "this scenario has no laser");
    std::string state;
    if (word == "beam") arguments >> state;
    if (word == "beam" && state != "on" && state != "off")
        return fail(Fault::bad_request, "the beam is on or off");
    if (hpi_ != nullptr) return obey_hpi(word, state);
    if (word == "beam") return laser_->set_beam(state == "on"), Result<void>{};
    if (word == "restart-counter") return laser_->restart_counter(), Result<void>{};
    int number = 0;
    arguments >> number;
    if (!arguments) return fail(Fault::bad_request, word + " needs a number");
    if (word == "skip") laser_->skip_records(number);
    if (word == "fields") laser_->set_fields(number);
    if (word == "error-mask") laser_->set_error_mask(number);
    return {};
}

Result<void> Simulator::obey_steer(std::istream& arguments) {
    if (!laser_ && ids_ == nullptr && hpi_ == nullptr)
        return fail(Fault::not_found, "this scenario has no laser");
    double milliradians = 0;
    if (!(arguments >> milliradians)) return fail(Fault::bad_request, "steer needs milliradians");
    if (laser_) laser_->steer(milliradians * 1e-3);
    if (ids_ != nullptr) ids_->steer(milliradians * 1e-3);
    if (hpi_ != nullptr) hpi_->steer(milliradians * 1e-3);
    return {};
}

Result<void> Simulator::obey_move(std::istream& arguments) {
    if (!laser_) return fail(Fault::not_found, "move-optic is of a laser that a µMD counts");
    double by_um = 0;
    if (!(arguments >> by_um)) return fail(Fault::bad_request, "move-optic needs micrometres");
    return laser_->move_optic(by_um * 1e-3), Result<void>{};
}

Result<void> Simulator::obey_bar(std::istream& arguments) {
    std::uint64_t records = 0;
    if (bar_ == nullptr) return fail(Fault::not_found, "this scenario has no ballbar");
    if (!(arguments >> records)) return fail(Fault::bad_request, "skip-bar needs a number");
    return bar_->leave_out(records), Result<void>{};
}

Result<void> Simulator::obey_cnc(const std::string& word, std::istream& arguments) {
    if (!runner_) return fail(Fault::not_found, "this scenario has no CNC");
    std::string argument;
    arguments >> argument;
    if (word == "run") {
        if (!argument.empty()) program_ = argument;
        return runner_->start(program_);
    }
    if (word == "stop") return runner_->stop(), Result<void>{};
    if (word == "motion-fault")
        return runner_->inject(argument == "none" ? "" : argument), Result<void>{};
    if (word == "go") return runner_->go(), Result<void>{};
    int number = 0;
    if (word == "hold" && !(std::istringstream{argument} >> number))
        return fail(Fault::bad_request, "hold needs the number of requests after which");
    if (word == "hold") return runner_->hold(number), Result<void>{};
    int port = 0;
    arguments >> port;
    if (client_ == nullptr || port == 0)
        return fail(Fault::bad_request, "connect HOST PORT needs a CNC that is a TCP client");
    return client_->redirect({argument, port}), Result<void>{};
}

Result<nlohmann::json> Simulator::obey(const std::string& word, std::istream& arguments) {
    const auto done = [](const Result<void>& outcome) -> Result<nlohmann::json> {
        if (!outcome) return tl::unexpected<Error>(outcome.error());
        return nlohmann::json{{"ok", true}};
    };
    std::string name, behaviour;
    if (word == "status") return status();
    if (word == "quit") return ended_ = true, done({});
    if (word == "truth") return arguments >> name, done(write_truth(name));
    if (word == "sensor") {
        arguments >> name >> behaviour;
        if (laser_ && name == "laser") return done(laser_->behave(behaviour));
        for (const auto& sensor : sensors_)
            if (sensor->name() == name) return done(sensor->behave(behaviour));
        return fail(Fault::not_found, "no sensor is named \"" + name + "\"");
    }
    if (word == "beam" || word == "restart-counter" || word == "skip" || word == "fields" ||
        word == "error-mask")
        return done(obey_laser(word, arguments));
    if (word == "steer") return done(obey_steer(arguments));
    if (word == "move-optic") return done(obey_move(arguments));
    if (word == "skip-bar") return done(obey_bar(arguments));
    if (word == "run" || word == "stop" || word == "motion-fault" || word == "connect" ||
        word == "hold" || word == "go")
        return done(obey_cnc(word, arguments));
    return fail(Fault::bad_request, "\"" + word + "\" is no command");
}

nlohmann::json Simulator::command(const std::string& line) {
    const std::lock_guard lock{command_mutex_};
    std::istringstream arguments{line};
    std::string word;
    arguments >> word;
    auto answer = obey(word, arguments);
    if (answer) return *answer;
    return {{"ok", false}, {"error", answer.error().detail}};
}

} // namespace axiscal::simulate
