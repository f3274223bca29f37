#include "acquisition/documents/circular/circular_run_file.hpp"

#include "acquisition/documents/circular/circular_json.hpp"
#include "acquisition/documents/result_digest.hpp"
#include "acquisition/runfile/stream_packing.hpp"
#include "analysis/circular/circle_cut.hpp"
#include "analysis/record/stream_rate.hpp"

#include <algorithm>
#include <vector>

namespace axiscal {
namespace {

/// Of the named channels, all readings within [begin, end]; without any the last one before.
CircularTemperature temperature_of(const RunRecord& run,
                                   const std::vector<int>& channels,
                                   MonotonicTime begin,
                                   MonotonicTime end) {
    CircularTemperature found;
    double sum = 0;
    int n = 0;
    const auto take = [&](double value_degC) {
        found.low_degC = n == 0 ? value_degC : std::min(found.low_degC, value_degC);
        found.high_degC = n == 0 ? value_degC : std::max(found.high_degC, value_degC);
        sum += value_degC;
        ++n;
    };
    std::optional<double> before;
    for (const EnvironmentReading& reading : run.environment) {
        if (std::ranges::find(channels, reading.channel) == channels.end()) continue;
        if (reading.at < begin) before = reading.value;
        if (reading.at >= begin && reading.at <= end) take(reading.value);
    }
    if (n == 0 && before) take(*before);
    if (n > 0) found.mean_degC = sum / n;
    for (const ChannelRecord& channel : run.channels)
        if (std::ranges::find(channels, channel.id) != channels.end())
            found.channel += (found.channel.empty() ? "" : ", ") + channel.name;
    return found;
}

std::vector<int> temperature_channels(const RunRecord& run, Medium medium, std::optional<int> but) {
    std::vector<int> ids;
    for (const ChannelRecord& channel : run.channels)
        if (channel.kind == ChannelKind::temperature && channel.medium == medium &&
            channel.id != but && !sits_on_scale(run, channel.id))
            ids.push_back(channel.id);
    return ids;
}

CircularBar bar_of(const RunRecord& run, const CircularSetup& setup) {
    CircularBar bar;
    bar.instrument.name = setup.bar_instrument;
    for (const InstrumentRecord& instrument : run.instruments)
        if (instrument.name == setup.bar_instrument) bar.instrument = instrument;
    bar.length_mm = setup.bar_length_mm;
    bar.alpha_per_K = setup.bar_alpha_per_K;
    bar.calibration_U_um = setup.uncertainty.calibration_U_um;
    bar.calibration_k = setup.uncertainty.calibration_k;
    bar.sign = setup.bar_sign;
    return bar;
}

void take_temperatures(CircularRun& circular, const RunRecord& run, const CircularSetup& setup) {
    const auto evaluated = [](const CircleCapture& circle) { return !circle.warm_up; };
    const auto first = std::ranges::find_if(circular.circles, evaluated);
    if (first == circular.circles.end()) return;
    const MonotonicTime begin = first->begin, end = circular.circles.back().end;
    const auto bar = setup.bar_temperature_channel;
    if (bar) circular.bar_temperature = temperature_of(run, {*bar}, begin, end);
    circular.machine_temperature =
        temperature_of(run, temperature_channels(run, Medium::material, bar), begin, end);
    circular.air_temperature =
        temperature_of(run, temperature_channels(run, Medium::air, bar), begin, end);
}

CircularRun header_of(const RunRecord& run, const CircularSetup& setup) {
    CircularRun circular;
    circular.run_id = run.run_id;
    circular.software_version = run.software_version;
    circular.station = run.station;
    circular.config_hash = run.config_hash;
    circular.opened = run.opened;
    circular.closed = run.closed;
    circular.complete = run.complete;
    circular.closing_reason = run.closing_reason;
    circular.plan = setup.plan;
    circular.capture = setup.capture;
    circular.bar = bar_of(run, setup);
    circular.statements = run.statements;
    circular.instruments = run.instruments;
    circular.channels = run.channels;
    circular.calibrations = run.calibrations;
    circular.machine_alpha_per_K = setup.machine_alpha_per_K;
    circular.uncertainty = setup.uncertainty;
    circular.tolerances = run.tolerances;
    circular.events = run.events;
    return circular;
}

} // namespace

Result<CircularRun> circular_run_of(const RunFileContents& contents) {
    const auto* known = std::get_if<CircularSetup>(&contents.attachments.setup);
    if (known == nullptr || contents.streams.empty())
        return fail(Fault::refused, "run " + contents.run.run_id + " holds no circular test");
    const CircularSetup& setup = *known;
    CircularRun circular = header_of(contents.run, setup);
    circular.preflight = contents.revisions.preflight;
    circular.orders = contents.revisions.orders;
    circular.eve_source = contents.attachments.eve_source;
    AXISCAL_TRY(const StreamSamples stream,
                samples_of(contents.blocks, contents.streams.front().id));
    // That of the set-up was seen in the second before arming; this one spans the run.
    if (const double seen = nominal_rate_hz(stream); seen > 0)
        circular.capture.sample_rate_hz = seen;
    circular.gaps = stream.gaps.size();
    circular.dropped_blocks = stream.dropped_blocks;
    for (const StreamGap& gap : stream.gaps)
        circular.missing += gap.missing;
    AXISCAL_TRY(circular.circles,
                cut_circles(setup, stream, circle_marks(setup.plan, contents.run.events)));
    take_temperatures(circular, contents.run, setup);
    return circular;
}

Result<CircularCertificate> circular_certificate_of(const std::string& path,
                                                    const RunFileContents& contents) {
    if (!contents.closed)
        return fail(Fault::incomplete_run, path + " is still open: close the run first");
    AXISCAL_TRY(CircularRun run, circular_run_of(contents));
    AXISCAL_TRY(CircularMeasurement measured, measurement_of(std::move(run)));
    AXISCAL_TRY(CircularCertificate certificate, evaluate_measurement(std::move(measured), {}));
    certificate.result_digest = result_digest(certificate.parameters);
    return certificate;
}

nlohmann::ordered_json circular_figures(const CircularCertificate& certificate) {
    return circular_to_json({certificate.measured.test, certificate.measured.axes,
                             certificate.parameters, certificate.diagnosis, certificate.budget});
}

} // namespace axiscal
