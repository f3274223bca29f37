#include "wire/usb/urb_server.hpp"

#include "wire/usb/usb_descriptors.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <poll.h>
#include <sys/socket.h>

namespace axiscal::simulate {

namespace {

/// The kernel never asks for more in one transfer of the drivers in use; a lost stream would.
constexpr std::uint32_t largest_transfer = 1 << 20;

bool receive(int socket, std::uint8_t* into, std::size_t size) {
    while (size > 0) {
        const ssize_t n = ::recv(socket, into, size, MSG_WAITALL);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return false;
        into += n;
        size -= static_cast<std::size_t>(n);
    }
    return true;
}

bool send_all(int socket, const Bytes& bytes) {
    std::size_t sent = 0;
    while (sent < bytes.size()) {
        const ssize_t n = ::send(socket, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return false;
        sent += static_cast<std::size_t>(n);
    }
    return true;
}

/// Each direction of an endpoint is a queue of its own.
int queue_of(const UrbSubmit& urb) {
    return urb.endpoint | (urb.in ? 0x80 : 0);
}

} // namespace

UsbAnswer UrbServer::standard(const UsbSetup& setup, UsbAnswer answer) const {
    constexpr int configuration = 2;
    constexpr std::size_t cut_by = 5; // the last endpoint is told by half
    const bool bytes = setup.value >> 8 == configuration && answer.bytes.size() > 2 * cut_by;
    if (faults_.fault() == UsbFault::descriptors && bytes)
        answer.bytes.resize(answer.bytes.size() - cut_by);
    return answer;
}

UsbAnswer UrbServer::ask(const Transfer& transfer) {
    const UrbSubmit& urb = transfer.urb;
    if (urb.endpoint == 0)
        if (auto answer = standard_answer(device_.descriptors(), urb.setup))
            return standard(urb.setup, std::move(*answer));
    if (faults_.fault() == UsbFault::mute) return UsbAnswer::hold();
    if (faults_.fault() == UsbFault::stall) return UsbAnswer::stall();
    UsbAnswer answer = urb.endpoint == 0 ? device_.control(urb.setup, transfer.data)
                       : urb.in          ? device_.in(urb.endpoint, urb.length)
                                         : device_.out(urb.endpoint, transfer.data);
    return urb.in ? faults_.spoil(std::move(answer)) : answer;
}

bool UrbServer::finish(int socket, const Transfer& transfer, const UsbAnswer& answer) {
    const UrbSubmit& urb = transfer.urb;
    if (answer.how == UsbAnswer::How::stall)
        return send_all(socket, encode_return(urb.sequence, -EPIPE, 0, {}));
    if (!urb.in) return send_all(socket, encode_return(urb.sequence, 0, urb.length, {}));
    const std::size_t size = std::min<std::size_t>(answer.bytes.size(), urb.length);
    const std::span bytes{answer.bytes.data(), size};
    return send_all(socket,
                    encode_return(urb.sequence, 0, static_cast<std::uint32_t>(size), bytes));
}

bool UrbServer::unlink(int socket, const UrbUnlink& unlink) {
    const auto victim = std::find_if(held_.begin(), held_.end(), [&](const Transfer& transfer) {
        return transfer.urb.sequence == unlink.victim;
    });
    const bool was_held = victim != held_.end();
    if (was_held) held_.erase(victim);
    return send_all(socket, encode_unlinked(unlink.sequence, was_held ? -ECONNRESET : 0));
}

/// One message of the host; false when it is gone or talks nonsense.
bool UrbServer::take_one(int socket) {
    UsbipHeader header{};
    if (!receive(socket, header.data(), header.size())) return false;
    const UrbRequest request = decode_urb(header);
    if (const auto* taken_back = std::get_if<UrbUnlink>(&request))
        return unlink(socket, *taken_back);
    const auto* submit = std::get_if<UrbSubmit>(&request);
    if (submit == nullptr || submit->length > largest_transfer) return false;
    Transfer transfer{*submit, {}};
    if (!submit->in) transfer.data.resize(submit->length);
    if (!receive(socket, transfer.data.data(), transfer.data.size())) return false;
    held_.push_back(std::move(transfer));
    return true;
}

bool UrbServer::ask_held_again(int socket) {
    std::set<int> blocked;
    finished_some_ = false;
    for (auto transfer = held_.begin(); transfer != held_.end();) {
        const int queue = queue_of(transfer->urb);
        const UsbAnswer answer = blocked.contains(queue) ? UsbAnswer::hold() : ask(*transfer);
        if (answer.how == UsbAnswer::How::hold) {
            blocked.insert(queue);
            ++transfer;
            continue;
        }
        if (!finish(socket, *transfer, answer)) return false;
        transfer = held_.erase(transfer);
        finished_some_ = true;
    }
    return true;
}

void UrbServer::serve(int socket, const std::stop_token& stop) {
    held_.clear();
    device_.plugged();
    bool in_vain = false; // bytes are there, but no transfer to take them: wait a pace
    while (!stop.stop_requested()) {
        const int wake = held_.empty() || in_vain ? -1 : device_.wake_descriptor();
        std::array<pollfd, 2> polls{pollfd{socket, POLLIN, 0}, pollfd{wake, POLLIN, 0}};
        const bool woken = held_.empty() || wake >= 0;
        constexpr int look_for_stop_ms = 50;
        const auto pace = static_cast<int>(device_.pace().count());
        ::poll(polls.data(), polls.size(), woken ? look_for_stop_ms : pace);
        if (polls[0].revents != 0 && !take_one(socket)) return;
        if (!ask_held_again(socket)) return;
        in_vain = polls[1].revents != 0 && !finished_some_;
    }
}

} // namespace axiscal::simulate
