#pragma once
// Where this PC is told to mount something, and whether anything is mounted there. A share that is
// away leaves an empty folder of this PC's own disk, which looks like the share. Reads files of the
// system, no state.

#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// Where it is read; other files in tests.
struct MountPlaces {
    std::string mounted = "/proc/self/mountinfo"; ///< of this process' own namespace: proc(5)
    std::string fstab = "/etc/fstab";
    /// Folders of systemd's .mount units.
    std::vector<std::string> units{"/etc/systemd/system", "/run/systemd/system"};
};

/// A mount point that the system is told of and that carries nothing now.
struct AbsentMount {
    std::string point;    ///< "/mnt/quality"
    std::string named_in; ///< "/etc/fstab", "/etc/systemd/system/mnt-quality.mount"
    std::string way_out;  ///< "sudo mount /mnt/quality"
};

/// The one at `folder` or above it, the outermost of several; none where all of them are mounted.
/// Looks into the mount point, so that an automount comes: may block for as long as that takes. A
/// folder that was bound over itself, as the sandbox of a service does with its ReadWritePaths, is
/// no mount. Where the list of mounts cannot be read nothing counts as mounted.
std::optional<AbsentMount> absent_mount(const std::string& folder, const MountPlaces& places = {});
/// For people: mount point, who names it, way out. The second one as a sentence about the share.
std::string not_mounted_text(const AbsentMount& absent);
std::string absent_mount_text(const AbsentMount& absent);

/// "fuse.rclone", as the kernel calls the file system that carries the folder; "" where unknown.
std::string file_system_of(const std::string& folder, const MountPlaces& places = {});

} // namespace axiscal
