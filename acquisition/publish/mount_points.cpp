#include "acquisition/publish/mount_points.hpp"

#include "acquisition/runfile/durable_file.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mntent.h>
#include <sstream>

namespace axiscal {
namespace {

namespace fs = std::filesystem;

/// One line of mountinfo, proc_pid_mountinfo(5).
struct Mount {
    std::string id, parent, device;
    std::string root; ///< the folder of that file system which is seen at `point`
    std::string point, type;
};

/// Blanks and backslashes stand as \040 there.
std::string without_octals(const std::string& text) {
    constexpr std::size_t digits = 3;
    std::string plain;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const bool escape =
            text[at] == '\\' && text.size() - at > digits && text[at + 1] <= '3' &&
            text.find_first_not_of("01234567", at + 1) >= std::min(at + 1 + digits, text.size());
        if (!escape) {
            plain += text[at];
            continue;
        }
        plain += static_cast<char>(std::stoi(text.substr(at + 1, digits), nullptr, 8));
        at += digits;
    }
    return plain;
}

std::vector<Mount> mounts_in(const std::string& list) {
    std::vector<Mount> mounts;
    std::ifstream file{list};
    for (std::string line; std::getline(file, line);) {
        std::istringstream words{line};
        Mount one;
        words >> one.id >> one.parent >> one.device >> one.root >> one.point;
        for (std::string word; words >> word && word != "-";) // options, as many as there are
            continue;
        words >> one.type;
        one.root = without_octals(one.root);
        one.point = without_octals(one.point);
        if (words) mounts.push_back(std::move(one));
    }
    return mounts;
}

/// "" for what lies elsewhere; `folder` itself is "/".
std::string path_below(const std::string& folder, const std::string& path) {
    const std::string start = folder == "/" ? "" : folder;
    if (path == folder) return "/";
    return path.starts_with(start + "/") ? path.substr(start.size()) : "";
}

std::string joined(const std::string& folder, const std::string& below) {
    if (below == "/") return folder;
    return folder == "/" ? below : folder + below;
}

/// Bound over itself: it shows what its parent shows at that place anyhow.
bool shows_nothing_new(const Mount& mount, const std::vector<Mount>& all) {
    const auto parent = std::ranges::find(all, mount.parent, &Mount::id);
    if (parent == all.end() || parent->device != mount.device) return false;
    const std::string below = path_below(parent->point, mount.point);
    return !below.empty() && mount.root == joined(parent->root, below);
}

// An autofs stands for a mount that did not come although somebody looked.
bool is_mounted(const std::string& point, const std::vector<Mount>& all) {
    return std::ranges::any_of(all, [&](const Mount& mount) {
        return mount.point == point && mount.type != "autofs" && !shows_nothing_new(mount, all);
    });
}

std::string tidy(const std::string& path) {
    auto text = fs::path{path}.lexically_normal().string();
    if (text.size() > 1 && text.back() == '/') text.pop_back();
    return text;
}

/// Links followed as far as there are folders.
std::string resolved(const std::string& path) {
    std::error_code error;
    const auto found = fs::weakly_canonical(path, error);
    return error ? tidy(path) : tidy(found.string());
}

/// As a shell takes it.
std::string as_one_word(const std::string& word) {
    return word.find(' ') == std::string::npos ? word : "'" + word + "'";
}

std::vector<AbsentMount> named_by_fstab(const std::string& fstab) {
    constexpr std::size_t longest_line = 4096;
    std::vector<AbsentMount> named;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file{::setmntent(fstab.c_str(), "re"),
                                                               ::endmntent};
    std::array<char, longest_line> words{};
    mntent line{};
    while (file && ::getmntent_r(file.get(), &line, words.data(), words.size())) {
        const std::string point = tidy(line.mnt_dir);
        if (point.starts_with('/') && point != "/") // swap has "none"
            named.push_back({point, fstab, "sudo mount " + as_one_word(point)});
    }
    return named;
}

/// Where= of [Mount], systemd.mount(5); "" where there is none.
std::string where_of(const std::string& unit) {
    std::ifstream file{unit};
    std::string section, where;
    for (std::string line; std::getline(file, line);) {
        while (!line.empty() && (line.back() == ' ' || line.back() == '\r'))
            line.pop_back();
        const auto equals = line.find('=');
        if (line.starts_with('[')) section = line;
        if (section != "[Mount]" || equals == std::string::npos) continue;
        const auto key_end = line.find_last_not_of(' ', equals - 1);
        const auto begin = line.find_first_not_of(' ', equals + 1);
        if (line.substr(0, key_end + 1) == "Where" && begin != std::string::npos)
            where = line.substr(begin);
    }
    for (auto at = where.find("%%"); at != std::string::npos; at = where.find("%%", at + 1))
        where.erase(at, 1);
    return where;
}

std::vector<AbsentMount> named_by_units(const std::string& folder) {
    std::vector<AbsentMount> named;
    std::error_code error;
    for (fs::directory_iterator at{folder, error}, end; !error && at != end; at.increment(error)) {
        if (at->path().extension() != ".mount") continue;
        const std::string where = where_of(at->path().string());
        if (where.starts_with('/'))
            named.push_back({tidy(where), at->path().string(),
                             "sudo systemctl start '" + at->path().filename().string() + "'"});
    }
    return named;
}

std::vector<AbsentMount> named_mounts(const MountPlaces& places) {
    auto named = named_by_fstab(places.fstab);
    for (const auto& folder : places.units)
        std::ranges::move(named_by_units(folder), std::back_inserter(named));
    std::ranges::stable_sort(named, {}, [](const AbsentMount& one) { return one.point.size(); });
    return named;
}

/// Opening it makes an automount come, as a mere stat(2) of it would not.
void look_into(const std::string& folder) {
    const FileHandle looked{
        ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NONBLOCK | O_CLOEXEC)};
}

} // namespace

std::optional<AbsentMount> absent_mount(const std::string& folder, const MountPlaces& places) {
    // As it is written, and where it leads: each may be what the system is told of. Of a mount
    // point that is not on the way nothing is asked: its server may be dead.
    const std::string written = tidy(folder), leads_to = resolved(folder);
    for (auto& named : named_mounts(places)) {
        if (path_below(named.point, written).empty() && path_below(named.point, leads_to).empty())
            continue;
        look_into(named.point);
        if (!is_mounted(resolved(named.point), mounts_in(places.mounted))) return std::move(named);
    }
    return std::nullopt;
}

std::string not_mounted_text(const AbsentMount& absent) {
    return "nothing is mounted at " + absent.point + ", a mount point of " + absent.named_in +
           "; mount it: " + absent.way_out;
}

std::string absent_mount_text(const AbsentMount& absent) {
    return "The share is away: " + not_mounted_text(absent);
}

std::string file_system_of(const std::string& folder, const MountPlaces& places) {
    const std::string path = resolved(folder);
    std::string point, type;
    for (const auto& mount : mounts_in(places.mounted)) {
        if (mount.point.size() < point.size() || path_below(mount.point, path).empty()) continue;
        point = mount.point; // of several at one place the last one is seen
        type = mount.type;
    }
    return type;
}

} // namespace axiscal
