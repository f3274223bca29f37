#pragma once
// The drift test: every channel against time while the axis, or the ballbar, rests, without a CNC.

#include "acquisition/capture/sample_history.hpp"
#include "acquisition/live/station_interface.hpp"
#include "acquisition/measurement/drift/drift_recorder.hpp"
#include "acquisition/measurement/drift/resting_test.hpp"
#include "acquisition/measurement/measurement.hpp"

#include <memory>
#include <optional>
#include <string>

namespace axiscal {

/// It ends by itself: when its time is over, when the counter loses its zero or when the disk takes
/// no records. A file that could not be closed is left to the next start of the daemon.
class DriftMeasurement final : public Measurement {
public:
    /// Makes its run file; begin() records. @errors as Journal::open.
    static Task<Result<std::shared_ptr<DriftMeasurement>>> open(MeasurementContext context,
                                                                RestingTest test);
    /// Of a run file that the journal has open; by open() alone.
    /// @param path  of that file
    DriftMeasurement(const MeasurementContext& context, const RestingTest& test, std::string path);

    [[nodiscard]] const RunState& run() const override { return run_; }
    void begin(const Orderer& by) override;
    void on_sample(const Sample& sample) override;
    Task<Result<RunEnding>> abort(std::string reason, Orderer by) override;
    [[nodiscard]] DriftView view() const;
    void put_on_status(StationStatus& shown) const override;

private:
    static Task<void> record(std::shared_ptr<DriftMeasurement> test);
    static Task<void> break_off(std::shared_ptr<DriftMeasurement> test, std::string reason);
    [[nodiscard]] std::shared_ptr<DriftMeasurement> held();
    /// It records, and the daemon goes on.
    [[nodiscard]] bool goes_on() const;
    void take_readings();
    /// Why nothing more can be recorded, if so.
    [[nodiscard]] std::optional<std::string> hindrance() const;
    /// Does nothing while it is being closed already.
    Task<void> close(bool complete, std::string reason);
    Task<void> certify();
    Task<Result<RunEnding>> await_closing();

    MeasurementContext context_;
    int watched_; ///< channel of the laser, scale or ballbar
    DriftRecorder recorder_;
    std::optional<SampleHistory> bar_; ///< of a test of the ballbar: its last readings
    RunState run_;
};

} // namespace axiscal
