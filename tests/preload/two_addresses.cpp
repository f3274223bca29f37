// Loaded into a program: "localhost" is ::1 first, then 127.0.0.1, as /etc/hosts of Debian has it,
// whatever this computer's has.
#include <cstring>
#include <dlfcn.h>
#include <netdb.h>

namespace {

using Look = int(const char*, const char*, const addrinfo*, addrinfo**);

int look(const char* address, const char* service, const addrinfo* hints, addrinfo** found) {
    static const auto real = reinterpret_cast<Look*>(::dlsym(RTLD_NEXT, "getaddrinfo"));
    return real(address, service, hints, found);
}

} // namespace

extern "C" int
getaddrinfo(const char* name, const char* service, const addrinfo* hints, addrinfo** found) {
    if (name == nullptr || std::strcmp(name, "localhost") != 0)
        return look(name, service, hints, found);
    addrinfo numeric{};
    if (hints != nullptr) numeric.ai_socktype = hints->ai_socktype;
    addrinfo* second = nullptr;
    if (const int failed = look("127.0.0.1", service, &numeric, &second); failed != 0)
        return failed;
    if (look("::1", service, &numeric, found) != 0) return *found = second, 0;
    addrinfo* last = *found;
    while (last->ai_next != nullptr)
        last = last->ai_next;
    last->ai_next = second;
    return 0;
}
