// The state directory and the place where certificates go.
#include "acquisition/live/outbox_watch.hpp"
#include "acquisition/publish/mount_points.hpp"
#include "config/share_address.hpp"
#include "tools/axiscal/doctor/doctor.hpp"
#include "tools/axiscal/selftest/selftest.hpp"

#include <filesystem>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <unistd.h>

namespace axiscal {
namespace {

namespace fs = std::filesystem;

constexpr int commits = 10; // enough to see whether one is possible; axiscal selftest times them

bool is_folder(const std::string& path) {
    std::error_code error;
    return fs::is_directory(path, error);
}

Finding check_commit(const std::string& folder) {
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        return {Health::note, "disk",
                "whether a point can be made durable was not tried: this user may not write to " +
                    folder,
                "sudo axiscal doctor"};
    const auto took = measure_commit(folder, commits);
    if (!took)
        return {Health::broken, "disk", "no point can be made durable: " + describe(took.error()),
                "sudo dmesg | tail shows why a disk fails; is it full or read-only?"};
    const SelftestVerdict verdict = judge_commit(*took);
    return {verdict.ok ? Health::good : Health::note, "disk", verdict.sentence,
            verdict.ok ? "" : "axiscal selftest --state-directory " + folder};
}

/// Where no file of the system names a mount point, the folders that people mount in are a hint.
bool is_bare_mount_point(const std::string& path) {
    struct stat here {
    }, root{};
    const bool below = path.starts_with("/mnt/") || path.starts_with("/media/");
    return below && ::stat(path.c_str(), &here) == 0 && ::stat("/", &root) == 0 &&
           here.st_dev == root.st_dev;
}

Finding check_folder(const std::string& folder, const Account& service, const MountPlaces& mounts) {
    if (const auto absent = absent_mount(folder, mounts))
        return {Health::broken, "share", absent_mount_text(*absent), absent->way_out};
    if (!is_folder(folder))
        return {Health::broken, "share", "the destination " + folder + " is not there",
                "mount it (sudo mount " + folder + "), or correct publish.destination"};
    if (!may_use(service, folder))
        return {Health::broken, "share",
                "the user " + service.name + " may not write to " + folder + " (" +
                    rights_text(folder) + ")",
                "mount it with uid=axiscal,gid=axiscal (docs/install.md)"};
    if (is_bare_mount_point(folder))
        return {Health::note, "share", folder + " lies on this PC's own disk: nothing is mounted",
                "findmnt " + folder + "; then: sudo mount " + folder};
    return {Health::good, "share", folder + " can be written", ""};
}

/// A folder with the set-group-ID bit passes its group on to what is made in it; the service, which
/// sees no other users, could not.
Finding check_readers(const std::string& folder, const std::string& name) {
    const auto readers = group_named(name);
    if (!readers)
        return {Health::broken, "share",
                "there is no group " + name + ", which publish.group names",
                "sudo addgroup " + name};
    struct stat about {};
    constexpr mode_t passes_on = S_ISGID | S_IRGRP | S_IXGRP;
    const bool passes = ::stat(folder.c_str(), &about) == 0 && about.st_gid == *readers &&
                        (about.st_mode & passes_on) == passes_on;
    if (passes)
        return {Health::good, "share", "the group " + name + " reads what comes to " + folder, ""};
    return {Health::broken, "share",
            "the group " + name + " cannot read what comes to " + folder + " (" +
                rights_text(folder) + ")",
            "sudo chgrp " + name + " " + folder + " && sudo chmod g+rxs " + folder};
}

Finding check_server(const OutboxView& outbox, const std::string& destination) {
    if (outbox.state == "waiting")
        return {Health::broken, "share", destination + ": " + outbox.reason,
                "docs/share.md gives the command that tests it"};
    if (outbox.state.empty())
        return {Health::note, "share",
                "axiscal-publish has not reported on " + destination + " yet",
                "sudo systemctl start axiscal-publish"};
    return {Health::good, "share", destination + " was reached (" + outbox.since_utc + ")", ""};
}

} // namespace

std::vector<Finding> check_disk(const CheckedSystem& checked) {
    const std::string folder = checked.config != nullptr ? checked.config->state_directory
                                                         : StationConfig{}.state_directory;
    if (!is_folder(folder))
        return {{Health::broken, "disk", "the state directory " + folder + " is not there",
                 "sudo install -d -o axiscal -g axiscal -m 750 " + folder}};
    std::vector<Finding> found;
    if (may_use(checked.service, folder))
        found.push_back({Health::good, "disk",
                         folder + " belongs to " + checked.service.name + " or its group", ""});
    else
        found.push_back({Health::broken, "disk",
                         "the user " + checked.service.name + " may not write to " + folder + " (" +
                             rights_text(folder) + ")",
                         "sudo chown -R axiscal:axiscal " + folder});
    if (found.back().health == Health::good)
        for (Finding& finding : check_owners(folder, checked.service))
            found.push_back(std::move(finding));
    struct statfs about {};
    if (::statfs(folder.c_str(), &about) == 0) {
        DiskReading disk{folder, static_cast<long>(about.f_type), 0, true};
        disk.free_bytes = static_cast<double>(about.f_bavail) * static_cast<double>(about.f_bsize);
        disk.names_left = about.f_files == 0 || about.f_ffree > 0; // btrfs counts none
        for (Finding& finding : judge_disk(disk))
            found.push_back(std::move(finding));
    }
    found.push_back(check_commit(folder));
    return found;
}

std::vector<Finding>
check_share(const CheckedSystem& checked, std::int64_t utc_ns, const MountPlaces& mounts) {
    const PublishConfig& publish = checked.config->publish;
    if (publish.destination.empty())
        return {{Health::note, "share",
                 "no destination is configured: certificates stay in the outbox",
                 "write destination under [publish]"}};
    OutboxWatch watch{checked.config->state_directory, publish};
    const OutboxView outbox = watch.look({{}, utc_ns, {}}); // one look: by the files' times
    std::vector<Finding> found;
    found.push_back(is_share_address(publish.destination)
                        ? check_server(outbox, publish.destination)
                        : check_folder(publish.destination, checked.service, mounts));
    if (!publish.group.empty() && found.back().health != Health::broken)
        found.push_back(check_readers(publish.destination, publish.group));
    if (!outbox.publisher_runs)
        found.push_back({Health::note, "share", "axiscal-publish does not run",
                         "sudo systemctl enable --now axiscal-publish"});
    if (!outbox.alarm.empty())
        found.push_back({Health::broken, "share", outbox.alarm, "axiscal status; docs/share.md"});
    return found;
}

} // namespace axiscal
