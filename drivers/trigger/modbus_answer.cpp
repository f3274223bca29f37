#include "drivers/trigger/modbus_answer.hpp"

#include "drivers/trigger/mbap_framer.hpp"

#include <array>
#include <cerrno>
#include <linux/sockios.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

namespace axiscal {
namespace {

std::error_code last_error() {
    return {errno, std::generic_category()};
}

modbus_mapping_t mapping_over(RegisterImage& image) {
    modbus_mapping_t mapping{};
    mapping.nb_bits = image.space.coils;
    mapping.nb_input_bits = image.space.discrete_inputs;
    mapping.nb_registers = image.space.holding;
    mapping.nb_input_registers = image.space.input;
    mapping.tab_bits = image.coils.data();
    mapping.tab_input_bits = image.discrete_inputs.data();
    mapping.tab_registers = image.holding.data();
    mapping.tab_input_registers = image.input.data();
    return mapping;
}

} // namespace

// modbus_reply sleeps for its response time-out before some of its own exceptions (3.1.6); so it
// gets only requests that are known to be good, and refusals go out as ready-made exceptions.
bool answer_request(modbus_t* context,
                    std::span<const std::uint8_t> frame,
                    ModbusException verdict,
                    RegisterImage image) {
    if (verdict != ModbusException::none)
        return modbus_reply_exception(context, frame.data(), static_cast<unsigned>(verdict)) > 0;
    auto mapping = mapping_over(image);
    return modbus_reply(context, frame.data(), static_cast<int>(frame.size()), &mapping) > 0;
}

Result<std::unique_ptr<ModbusAnswerer>> ModbusAnswerer::open() {
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends.data()) != 0)
        return fail(Fault::io, "No socket pair for a Modbus client.", last_error());
    ModbusContext context{modbus_new_tcp("127.0.0.1", 0)};
    if (!context) {
        const auto cause = last_error();
        ::close(ends[0]);
        ::close(ends[1]);
        return fail(Fault::io, "libmodbus gave no context.", cause);
    }
    modbus_set_socket(context.get(), ends[0]);
    return std::unique_ptr<ModbusAnswerer>{
        new ModbusAnswerer{ends[0], ends[1], std::move(context)}};
}

ModbusAnswerer::ModbusAnswerer(int library_end, int our_end, ModbusContext context)
    : library_end_{library_end}
    , our_end_{our_end}
    , context_{std::move(context)} {}

ModbusAnswerer::~ModbusAnswerer() {
    ::close(library_end_);
    ::close(our_end_);
}

// An empty send buffer, of kilobytes, takes the 260 bytes of the longest answer whole.
Result<bool> ModbusAnswerer::answer_at_once(int socket,
                                            std::span<const std::uint8_t> frame,
                                            ModbusException verdict,
                                            const RegisterImage& image) {
    int untaken = 0;
    if (::ioctl(socket, SIOCOUTQ, &untaken) != 0 || untaken > 0) return false;
    modbus_set_socket(context_.get(), socket);
    const bool sent = answer_request(context_.get(), frame, verdict, image);
    const auto cause = last_error();
    modbus_set_socket(context_.get(), library_end_);
    if (!sent) return fail(Fault::io, "libmodbus could not send an answer.", cause);
    return true;
}

Result<std::vector<std::uint8_t>> ModbusAnswerer::answer(std::span<const std::uint8_t> frame,
                                                         ModbusException verdict,
                                                         const RegisterImage& image) {
    if (!answer_request(context_.get(), frame, verdict, image))
        return fail(Fault::io, "libmodbus did not answer a request.", last_error());
    std::vector<std::uint8_t> reply(MODBUS_TCP_MAX_ADU_LENGTH);
    const auto length = ::recv(our_end_, reply.data(), reply.size(), MSG_DONTWAIT);
    if (length <= 0) return fail(Fault::io, "libmodbus left no answer.", last_error());
    reply.resize(static_cast<std::size_t>(length));
    return reply;
}

} // namespace axiscal
