#include "acquisition/tls/tls_loading.hpp"

#include <dlfcn.h>
#include <filesystem>

namespace axiscal {
namespace {

/// As profiles and pages are found: nothing of the build is remembered.
std::string path_of_module() {
    std::error_code unreadable;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", unreadable);
    const auto beside = program.parent_path() / "../lib/axiscal/axiscald-tls.so";
    return beside.lexically_normal().string();
}

tl::unexpected<Error> no_module(const std::string& path, const std::string& why) {
    return fail(Fault::io, "cannot load " + path + ", which speaks TLS (" + why +
                               "); install the package axiscal anew, or take certificate and key "
                               "out of [console]");
}

std::string words_of_loader() {
    const char* const words = ::dlerror(); // NOLINT(concurrency-mt-unsafe): its own in each thread
    return words == nullptr ? "no reason is given" : words;
}

} // namespace

Result<TlsModule*> load_tls_module() {
    const std::string path = path_of_module();
    void* const library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) return no_module(path, words_of_loader());
    const auto entry = reinterpret_cast<TlsEntry>(::dlsym(library, tls_entry));
    if (entry == nullptr) return no_module(path, words_of_loader());
    TlsModule* const module = entry(tls_interface);
    if (module == nullptr) return no_module(path, "it is of another version than this program");
    return module;
}

} // namespace axiscal
