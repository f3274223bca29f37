#include "tools/axiscal/imports/zip_part.hpp"

#include <archive.h>
#include <archive_entry.h>

#include <array>
#include <memory>
#include <utility>

namespace axiscal {
namespace {

struct ArchiveEnd {
    void operator()(archive* open) const { archive_read_free(open); }
};
using OpenArchive = std::unique_ptr<archive, ArchiveEnd>;

tl::unexpected<Error> refuse_damaged() {
    return refuse(Fault::bad_case, "file",
                  "is a damaged ZIP: open it with the program that wrote it, and save it again as "
                  ".xlsx or CSV");
}

Result<std::string> unpacked(archive* open) {
    std::string bytes;
    std::array<char, 16'384> piece{};
    for (;;) {
        const auto count = archive_read_data(open, piece.data(), piece.size());
        if (count == 0) return bytes;
        if (count < 0) return refuse_damaged();
        bytes.append(piece.data(), static_cast<std::size_t>(count));
        if (bytes.size() > largest_part_bytes)
            return refuse(Fault::bad_case, "file",
                          "unpacks to more than " + std::to_string(largest_part_bytes >> 20) +
                              " MiB: save the one table as .xlsx or CSV");
    }
}

/// Whether the archive stands at the part of this name now.
Result<bool> find_part(archive* open, std::string_view name) {
    constexpr int most_parts = 10'000;
    for (int i = 0; i < most_parts; ++i) {
        archive_entry* entry = nullptr;
        const int told = archive_read_next_header(open, &entry);
        if (told == ARCHIVE_EOF) return false;
        if (told < ARCHIVE_WARN || entry == nullptr) return refuse_damaged();
        const char* const path = archive_entry_pathname(entry); // null: a name that is no text
        if (path == nullptr || name != path) continue;
        if (archive_entry_is_encrypted(entry) != 0)
            return refuse(Fault::bad_case, "file",
                          "is an encrypted ZIP: save it without a password");
        return true;
    }
    return refuse(Fault::bad_case, "file",
                  "is a ZIP of more than " + std::to_string(most_parts) + " parts: no workbook");
}

} // namespace

Result<std::optional<std::string>> zip_part(std::string_view zip, std::string_view name) {
    const OpenArchive open{archive_read_new()};
    if (!open) return refuse(Fault::bad_case, "file", "cannot be unpacked: no memory is left");
    archive_read_support_format_zip_seekable(open.get()); // by its directory, as spreadsheets do
    if (archive_read_open_memory(open.get(), zip.data(), zip.size()) != ARCHIVE_OK)
        return refuse_damaged();
    AXISCAL_TRY(const bool found, find_part(open.get(), name));
    if (!found) return std::optional<std::string>{};
    AXISCAL_TRY(std::string bytes, unpacked(open.get()));
    return std::optional{std::move(bytes)};
}

} // namespace axiscal
