// What a test does that has nothing to do there.
#include "acquisition/measurement/measurement.hpp"

#include "acquisition/measurement/revisable.hpp"

namespace axiscal {
namespace {

tl::unexpected<Error> nothing_is_armed() {
    return fail(Fault::no_run_armed, "'axiscal arm' opens a run");
}

} // namespace

Task<Result<void>> Measurement::go_on() {
    co_return Result<void>{};
}

bool Measurement::on_trigger(const TriggerEvent& /*event*/) {
    return false;
}

void Measurement::on_time(MonotonicTime /*now*/) {}

Result<void> Measurement::trigger() {
    return nothing_is_armed();
}

Result<void> Measurement::type_reading(double /*seconds_of_arc*/) {
    return nothing_is_armed();
}

void Measurement::judge_instruments() {}

void Measurement::keep_rest() {}

Task<Result<void>> Measurement::on_disk_back(MonotonicTime /*since*/) {
    co_return Result<void>{};
}

void Measurement::keep_certificate(const Result<std::string>& /*entry*/) {}

Result<std::shared_ptr<Revisable>> Measurement::to_be_added_to() {
    return fail(Fault::no_run_armed, "there is no run to add to");
}

std::optional<StreamView> Measurement::stream(std::size_t /*most*/) const {
    return std::nullopt;
}

PointsView Measurement::points(std::size_t /*from*/) const {
    return {};
}

void Measurement::put_on_axis(AxisView& /*axis*/, Length /*reading*/) const {}

void Measurement::put_on_port(PortStatus& /*status*/) const {}

} // namespace axiscal
