#include "drivers/trigger/mirrored_port.hpp"

#include "drivers/trigger/sequence_block_map.hpp"

#include <boost/asio/experimental/awaitable_operators.hpp>

#include <algorithm>
#include <exception>

namespace axiscal {
namespace {

using namespace boost::asio::experimental::awaitable_operators;
using namespace sequence_block;

constexpr Duration first_pause = std::chrono::milliseconds{250},
                   longest_pause = std::chrono::seconds{5};

} // namespace

MirroredPort::MirroredPort(std::unique_ptr<RegisterMap> map, TriggerConfig config)
    : MappedPort{std::move(map), std::move(config)} {}

Task<Result<void>> MirroredPort::run(TriggerContext context) {
    server_->attach(context);
    try {
        auto talking = stay_connected(context.scheduler);
        auto timing = server_->keep_time(context.scheduler);
        co_await (std::move(talking) || std::move(timing));
    } catch (const std::exception&) { // cancelled: the way a port ends
    }
    server_->detach();
    co_return fail(Fault::link_closed, describe() + " was stopped.");
}

Task<void> MirroredPort::stay_connected(Scheduler* scheduler) {
    Duration pause = first_pause;
    bool reported = false;
    for (;;) {
        ModbusClient cnc{scheduler, config_.host, config_.port, config_.unit_id};
        last_written_.clear();
        auto outcome = co_await cnc.connect();
        while (outcome) {
            const MonotonicTime next = scheduler->now() + config_.poll_interval;
            outcome = co_await exchange(cnc, scheduler);
            if (!outcome) break;
            if (reported) ++server_->counters.reconnects;
            if (reported) server_->note(Fault::none, describe() + " is connected again.");
            reported = false;
            pause = first_pause;
            co_await scheduler->sleep_until(next);
        }
        if (!reported) server_->note(outcome.error().fault, axiscal::describe(outcome.error()));
        reported = true;
        co_await scheduler->sleep_for(pause);
        pause = std::min(2 * pause, longest_pause);
    }
}

Task<Result<void>> MirroredPort::exchange(ModbusClient& cnc, Scheduler* scheduler) {
    auto request = co_await read_request(cnc, scheduler);
    if (!request) co_return request;
    co_return co_await write_answer(cnc, scheduler);
}

Task<Result<void>> MirroredPort::read_request(ModbusClient& cnc, Scheduler* scheduler) {
    auto first = co_await cnc.read_holding(config_.base_address, cnc_words);
    AXISCAL_CO_TRY(const Words block, std::move(first));
    const MonotonicTime at = scheduler->now();
    ++server_->counters.requests;
    if (block[command_sequence] != last_sequence_) {
        auto second = co_await cnc.read_holding(config_.base_address, cnc_words);
        AXISCAL_CO_TRY(const Words again, std::move(second));
        ++server_->counters.requests;
        // the heartbeat in word 0 may move on meanwhile
        if (!std::equal(block.begin() + 1, block.end(), again.begin() + 1, again.end())) {
            ++server_->counters.torn_reads; // the CNC is still writing: the next poll sees it whole
            co_return Result<void>{};
        }
        last_sequence_ = block[command_sequence];
    }
    const ModbusRequest write{modbus_function::write_registers, 0, 0, 0, block};
    server_->write(write, at);
    co_return Result<void>{};
}

Task<Result<void>> MirroredPort::write_answer(ModbusClient& cnc, Scheduler* scheduler) {
    const auto image = server_->image(scheduler->now());
    Words ours(image.holding.begin() + daemon_heartbeat, image.holding.end());
    if (ours == last_written_) co_return Result<void>{};
    auto written = co_await cnc.write_registers(config_.base_address + daemon_heartbeat, ours);
    if (!written) co_return written;
    ++server_->counters.requests;
    last_written_ = std::move(ours);
    co_return Result<void>{};
}

std::string MirroredPort::describe() const {
    return std::string{shape_name(config_.shape)} + " in the CNC's registers " +
           std::to_string(config_.base_address) + ".." +
           std::to_string(config_.base_address + words - 1) + ", Modbus TCP " + config_.host + ":" +
           std::to_string(config_.port);
}

} // namespace axiscal
