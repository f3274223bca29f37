#include "acquisition/console/page_files.hpp"

#include <boost/beast/zlib/inflate_stream.hpp>
#include <boost/crc.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

namespace axiscal {
namespace {

namespace page_fs = std::filesystem;

struct PageType {
    std::string_view ending, type;
};
constexpr std::array page_types{PageType{".html", "text/html; charset=utf-8"},
                                PageType{".css", "text/css; charset=utf-8"},
                                PageType{".js", "text/javascript; charset=utf-8"},
                                PageType{".json", "application/json; charset=utf-8"},
                                PageType{".svg", "image/svg+xml"},
                                PageType{".png", "image/png"},
                                PageType{".txt", "text/plain; charset=utf-8"}};
constexpr int deepest = 1; // folders below the page's own

/// Empty: no file of a page.
std::string_view page_type_of(std::string_view name) {
    for (const PageType& known : page_types)
        if (name.ends_with(known.ending)) return known.type;
    return {};
}

bool is_page_name(std::string_view name) {
    const auto plain = [](char letter) {
        return (letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9') ||
               letter == '_' || letter == '-' || letter == '.';
    };
    return !name.empty() && name.front() != '.' && std::ranges::all_of(name, plain);
}

/// FNV-1a of 64 bits: tells apart the versions of one file, and is no proof against anybody.
std::string etag_of(std::string_view bytes) {
    std::uint64_t mixed = 0xcbf29ce484222325U;
    for (const char byte : bytes)
        mixed = (mixed ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "\"%016llx\"", static_cast<unsigned long long>(mixed));
    return text.data();
}

/// No more than it had when it was counted.
Result<std::string> bytes_of_page_file(const page_fs::path& path, std::size_t size) {
    std::ifstream in{path, std::ios::binary};
    std::string bytes(size, '\0');
    in.read(bytes.data(), static_cast<std::streamsize>(size));
    if (!in.is_open() || in.bad())
        return fail(Fault::io, "cannot read " + path.string(), {errno, std::generic_category()});
    bytes.resize(static_cast<std::size_t>(in.gcount()));
    return bytes;
}

/// Of four bytes, the lowest first.
std::uint32_t number_in(std::string_view bytes) {
    std::uint32_t number = 0;
    for (std::size_t nth = 4; nth > 0; --nth)
        number = number << 8U | static_cast<unsigned char>(bytes[nth - 1]);
    return number;
}

constexpr std::size_t trailer_size = 8; // checksum and number of the bytes that went in

/// What gzip packed without a name (RFC 1952, 2.3). Empty: it is damaged, or something else.
std::string unpacked_of(std::string_view packed, std::size_t size) {
    namespace deflate = boost::beast::zlib;
    constexpr std::string_view head{"\x1f\x8b\x08\x00", 4}; // deflate, nothing optional behind
    constexpr std::size_t head_size = 10;
    if (packed.size() < head_size + trailer_size || !packed.starts_with(head)) return {};
    // The trailer stays: this inflater finds the end of a stream by what follows it.
    packed.remove_prefix(head_size);
    std::string bytes(size + 1, '\0'); // one more: it stops at a full buffer, also before the end
    deflate::z_params part;
    part.next_in = packed.data();
    part.avail_in = packed.size();
    part.next_out = bytes.data();
    part.avail_out = bytes.size();
    deflate::inflate_stream inflater;
    boost::system::error_code ended;
    inflater.write(part, deflate::Flush::finish, ended);
    if (ended != deflate::error::end_of_stream || part.avail_out != 1) return {};
    bytes.pop_back();
    return bytes;
}

/// Whether a browser can unpack these very bytes from it.
bool is_packed_of(std::string_view packed, std::string_view bytes) {
    if (packed.size() < trailer_size || unpacked_of(packed, bytes.size()) != bytes) return false;
    boost::crc_32_type checksum;
    checksum.process_bytes(bytes.data(), bytes.size());
    const std::string_view trailer = packed.substr(packed.size() - trailer_size);
    return number_in(trailer) == checksum.checksum() &&
           number_in(trailer.substr(4)) == bytes.size();
}

/// Empty where there is none that is smaller. The page is whole without it: nothing fails here.
std::string packed_form_of(page_fs::path path, std::string_view bytes) {
    path += ".gz";
    std::error_code gone;
    if (!page_fs::is_regular_file(page_fs::symlink_status(path, gone))) return {};
    const auto size = page_fs::file_size(path, gone);
    if (gone || size >= bytes.size()) return {};
    Result<std::string> packed = bytes_of_page_file(path, static_cast<std::size_t>(size));
    if (!packed || !is_packed_of(*packed, bytes)) return {};
    return *std::move(packed);
}

PageFile page_file_of(const page_fs::path& path, std::string bytes) {
    PageFile file;
    file.type = page_type_of(path.filename().string());
    file.etag = etag_of(bytes);
    file.packed = packed_form_of(path, bytes);
    file.packed_etag = etag_of(file.packed);
    if (file.packed.empty()) file.plain = std::move(bytes);
    return file;
}

std::string asked_as(const page_fs::path& path, const page_fs::path& folder) {
    const std::string name = path.lexically_relative(folder).generic_string();
    return name == "index.html" ? "/" : "/page/" + name;
}

tl::unexpected<Error> too_much_page(const std::string& folder) {
    return fail(Fault::bad_configuration,
                folder + " holds more than a page has: 200 files, 1 MiB together");
}

/// Of the folder that is walked through; links are not followed.
bool is_page_entry(const page_fs::directory_entry& entry) {
    std::error_code gone;
    const page_fs::file_status status = entry.symlink_status(gone);
    return !gone && page_fs::is_regular_file(status) &&
           is_page_name(entry.path().filename().string()) &&
           !page_type_of(entry.path().filename().string()).empty();
}

} // namespace

std::string PageFile::bytes() const {
    if (packed.empty()) return plain;
    const std::string_view size_in =
        std::string_view{packed}.substr(packed.size() - trailer_size / 2);
    return unpacked_of(packed, number_in(size_in));
}

Result<PageFiles> PageFiles::read(const std::string& folder) {
    PageFiles page;
    std::size_t bytes = 0;
    std::error_code error;
    page_fs::recursive_directory_iterator entry{folder, error};
    for (const page_fs::recursive_directory_iterator end; !error && entry != end;
         entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (entry.depth() >= deepest || !is_page_name(name)) entry.disable_recursion_pending();
        if (!is_page_entry(*entry)) continue;
        std::error_code unknown;
        const auto size = static_cast<std::size_t>(entry->file_size(unknown));
        bytes += size;
        if (unknown || bytes > most_bytes || page.files_.size() >= most_files)
            return too_much_page(folder);
        AXISCAL_TRY(std::string text, bytes_of_page_file(entry->path(), size));
        page.files_.emplace(asked_as(entry->path(), folder),
                            page_file_of(entry->path(), std::move(text)));
    }
    if (error) return fail(Fault::io, "cannot read the folder " + folder, error);
    if (!page.find("/")) return fail(Fault::not_found, folder + " holds no index.html");
    return page;
}

const PageFile* PageFiles::find(std::string_view path) const {
    const auto found = files_.find(path);
    return found == files_.end() ? nullptr : &found->second;
}

std::string page_folder() {
    const char* const stated = std::getenv("AXISCAL_PAGE_PATH"); // NOLINT(concurrency-mt-unsafe)
    if (stated && *stated != '\0') return stated;
    // Beside the program, wherever it was installed; nothing of the build is remembered.
    std::error_code unreadable;
    const auto program = page_fs::read_symlink("/proc/self/exe", unreadable);
    return (program.parent_path() / "../share/axiscal/page").lexically_normal().string();
}

bool names_etag(std::string_view field, std::string_view etag) {
    while (!field.empty()) {
        std::string_view one = field.substr(0, field.find(','));
        field.remove_prefix(std::min(field.size(), one.size() + 1));
        while (one.starts_with(' ') || one.starts_with('\t'))
            one.remove_prefix(1);
        while (one.ends_with(' ') || one.ends_with('\t'))
            one.remove_suffix(1);
        if (one.starts_with("W/")) one.remove_prefix(2); // GET compares weakly
        if (one == "*" || one == etag) return true;
    }
    return false;
}

} // namespace axiscal
