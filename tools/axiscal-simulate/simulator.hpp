#pragma once
// The whole simulated world of one scenario: faces, CNC, and the commands that change them.

#include "cnc/cnc_exchange.hpp"
#include "cnc/cnc_runner.hpp"
#include "wire/serial_cable.hpp"
#include "wire/simulated_bar.hpp"
#include "wire/simulated_hpi.hpp"
#include "wire/simulated_ids.hpp"
#include "wire/simulated_laser.hpp"

#include <condition_variable>
#include <memory>
#include <thread>
#include <vector>

namespace axiscal::simulate {

/// Which value of a line of an external position stream is what, from 1.
struct StreamFields {
    int laser = 1; ///< the drive of the laser's axis
    int table = 0; ///< the position that the indexing table is told, in steps; 0: nobody tells it
};

/// command() is thread-safe; the rest belongs to the thread that made it.
class Simulator {
public:
    /// Opens every wire; nothing runs yet. @errors io, refused.
    static Result<std::unique_ptr<Simulator>> open(const Scenario& scenario);
    ~Simulator();
    Simulator(const Simulator&) = delete;
    Simulator& operator=(const Simulator&) = delete;

    /// Starts the threads; with external positions laser and ballbar wait for feed_positions().
    void start(bool external_positions);
    /// Reads lines `n x y z ...` of a 1 kHz stream until its end or quit; a ballbar takes the two
    /// axes of its plane.
    void feed_positions(int descriptor, StreamFields fields);
    /// The same for what has come in so far; returns the unfinished rest of a line.
    std::string feed_lines(const std::string& text, StreamFields fields);
    /// The program that `run` without a file, and `truth`, use.
    void set_program(std::string path) { program_ = std::move(path); }
    Result<void> write_truth(const std::string& path);

    /// One line of the control channel; the answer is one JSON object:
    /// run [FILE], stop, beam off|on, restart-counter, skip N, fields 8|16, error-mask N, steer
    /// MRAD, move-optic UM, sensor NAME off|on|garbage|flood, motion-fault KIND|none, connect HOST
    /// PORT, hold N, go, status, truth FILE, quit.
    nlohmann::json command(const std::string& line);
    [[nodiscard]] nlohmann::json places() const;
    [[nodiscard]] bool ended() const { return ended_; }

private:
    explicit Simulator(const Scenario& scenario);
    Result<void> open_faces();
    void feed_faces(const std::vector<double>& values, StreamFields fields);
    void feed_table(double position);
    Result<nlohmann::json> obey(const std::string& word, std::istream& arguments);
    Result<void> obey_hpi(const std::string& word, const std::string& state);
    Result<void> obey_laser(const std::string& word, std::istream& arguments);
    Result<void> obey_steer(std::istream& arguments);
    Result<void> obey_move(std::istream& arguments);
    Result<void> obey_bar(std::istream& arguments);
    Result<void> obey_cnc(const std::string& word, std::istream& arguments);
    [[nodiscard]] nlohmann::json status() const;

    Scenario scenario_;
    SimClock clock_;
    CommandedAxis axis_, table_; ///< the table in degrees that it is turned back
    double told_position_ = 0;   ///< of the table, by a position stream
    CommandedPlane plane_;
    CncLines lines_;
    std::unique_ptr<SimulatedLaser> laser_;
    std::vector<std::unique_ptr<SimulatedDevice>> sensors_;
    SimulatedBar* bar_ = nullptr;        ///< one of them
    SimulatedIds* ids_ = nullptr;        ///< one of them: the laser in laser_'s place
    SimulatedHpi* hpi_ = nullptr;        ///< the same
    std::unique_ptr<SerialCable> cable_; ///< RTU: between the daemon's port and the CNC's
    std::unique_ptr<CncExchange> exchange_;
    CncClient* client_ = nullptr; ///< exchange_, where it is a client
    std::unique_ptr<CncRunner> runner_;
    std::mutex command_mutex_;
    std::string program_;
    std::atomic<bool> ended_{false};
    std::vector<std::jthread> threads_; ///< last: joined first
};

} // namespace axiscal::simulate
