#pragma once
// A folder of this PC, which may be a mounted share.

#include "acquisition/publish/destination.hpp"
#include "acquisition/publish/mount_points.hpp"

#include <optional>

namespace axiscal {

/// A mount point with nothing mounted is a lost share, asked before the first byte and after the
/// last one: what is written below it stays on this PC's own disk.
class FolderDestination final : public Destination {
public:
    explicit FolderDestination(std::string root, MountPlaces mounts = {})
        : root_{std::move(root)}
        , mounts_{std::move(mounts)} {}
    [[nodiscard]] std::string place() const override { return root_; }
    /// Also tries again the rename that this file system refused, so that nothing is copied anew
    /// while it still does.
    Result<void> check() override;
    Result<bool> make_folder(const std::string& path) override;
    Result<std::vector<std::string>> names_in(const std::string& folder) override;
    Result<std::string> sha256_of(const std::string& path, const Progress& progress) override;
    Result<std::string> write_and_read_back(const std::string& source,
                                            const std::string& path,
                                            const Progress& progress) override;
    /// Looks, then renames, where the file system knows no rename to a free name and no hard links.
    Result<void> move_to_free_name(const std::string& from, const std::string& to) override;
    Result<void> remove_file(const std::string& path) override;
    Result<void> sync_folder(const std::string& path) override;

private:
    struct Move {
        std::string from, to;
    };
    [[nodiscard]] std::string at(const std::string& path) const;
    [[nodiscard]] Result<void> check_mount() const;
    Result<void> look_and_rename(const std::string& from, const std::string& to);
    Result<void> try_refused_move();

    std::string root_;
    MountPlaces mounts_;
    std::optional<Move> refused_; ///< of a whole file, compared
};

} // namespace axiscal
