#include "drivers/wire/counter_link.hpp"

#include "drivers/wire/descriptor_link.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <linux/counter.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal {
namespace {

static_assert(sizeof(counter_watch) == sizeof(CounterWatch));

tl::unexpected<Error> closed(int descriptor, const std::string& what) {
    const std::error_code cause{errno, std::generic_category()};
    if (descriptor >= 0) ::close(descriptor);
    return fail(Fault::link_closed, what, cause);
}

bool is_pipe(int descriptor) {
    struct stat status {};
    return ::fstat(descriptor, &status) == 0 && S_ISFIFO(status.st_mode);
}

} // namespace

Result<std::unique_ptr<ByteLink>>
open_counter(Scheduler& scheduler, const std::string& path, const CounterWatch& watch) {
    const std::string name = "counter " + path;
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0)
        return closed(descriptor,
                      "cannot open " + name + " (Debian's own kernel is built without counters)");
    if (!is_pipe(descriptor)) {
        counter_watch wanted{};
        std::memcpy(&wanted, watch.data(), sizeof wanted);
        if (::ioctl(descriptor, COUNTER_ADD_WATCH_IOCTL, &wanted) != 0)
            return closed(descriptor, name + " does not have this event or count");
        if (::ioctl(descriptor, COUNTER_ENABLE_EVENTS_IOCTL) != 0)
            return closed(descriptor, name + " does not send its events");
    }
    DescriptorKind kind;
    kind.name = name;
    kind.is_socket = true; // no tty: nothing to give back at the end
    return std::make_unique<DescriptorLink>(scheduler, descriptor, std::move(kind));
}

} // namespace axiscal
