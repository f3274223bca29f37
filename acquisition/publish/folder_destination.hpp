#pragma once
// A folder of this PC, which may be a mounted share.

#include "acquisition/publish/destination.hpp"

namespace axiscal {

class FolderDestination final : public Destination {
public:
    explicit FolderDestination(std::string root)
        : root_{std::move(root)} {}
    [[nodiscard]] std::string place() const override { return root_; }
    Result<void> check() override;
    Result<bool> make_folder(const std::string& path) override;
    Result<std::vector<std::string>> names_in(const std::string& folder) override;
    Result<std::string> sha256_of(const std::string& path, const Progress& progress) override;
    Result<std::string> write_and_read_back(const std::string& source,
                                            const std::string& path,
                                            const Progress& progress) override;
    Result<void> move_to_free_name(const std::string& from, const std::string& to) override;
    Result<void> remove_file(const std::string& path) override;
    Result<void> sync_folder(const std::string& path) override;

private:
    [[nodiscard]] std::string at(const std::string& path) const;
    std::string root_;
};

} // namespace axiscal
