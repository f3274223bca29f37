#pragma once
// The files of the page at the machine (docs/page.md), read once at the start. What a client asks
// for is looked up by name and never becomes a path of the disk.

#include "analysis/quantity/result.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace axiscal {

struct PageFile {
    std::string type;        ///< of the content: "text/css; charset=utf-8"
    std::string etag;        ///< with its quotes; another one where the bytes differ
    std::string plain;       ///< as on the disk; empty where there is a packed form
    std::string packed_etag; ///< of `packed`, never that of the file itself
    std::string packed;      ///< the same by gzip (RFC 1952), smaller; empty: there is none

    /// As on the disk. Unpacked for the few that take no packed form: idle memory is dearer.
    [[nodiscard]] std::string bytes() const;
};

class PageFiles {
public:
    static constexpr std::size_t most_bytes = std::size_t{1} << 20; ///< all files, not packed
    static constexpr std::size_t most_files = 200;

    PageFiles() = default; ///< none: the page is not installed
    /// Files of `folder` and one folder below, with small letters, digits, '_', '-' and '.' in
    /// their names and an ending that a page has. Links, hidden files and all else are passed over.
    /// NAME.gz beside NAME is its packed form where it was packed from these very bytes; else it is
    /// passed over, too: somebody changed NAME since.
    /// @errors Fault::not_found without `index.html`; Fault::io for what cannot be read;
    /// Fault::bad_configuration for more than the limits above.
    static Result<PageFiles> read(const std::string& folder);

    /// @param path  as asked for: "/" is index.html, "/page/main.js" the file main.js
    /// @returns null where there is none
    [[nodiscard]] const PageFile* find(std::string_view path) const;
    [[nodiscard]] std::size_t count() const { return files_.size(); }

private:
    std::map<std::string, PageFile, std::less<>> files_; ///< by the path that is asked for
};

/// $AXISCAL_PAGE_PATH, else ../share/axiscal/page of the program. Before any thread exists.
std::string page_folder();

/// Whether a client has these bytes already (RFC 9110, 13.1.2). @param field  of If-None-Match
bool names_etag(std::string_view field, std::string_view etag);

} // namespace axiscal
