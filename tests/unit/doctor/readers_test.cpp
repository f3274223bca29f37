// Whether the folder of the results lets the group read them that the station file names.
#include "tests/support/scratch_folder.hpp"
#include "tools/axiscal/doctor/doctor.hpp"

#include <grp.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal::doctor_readers_test {
namespace {

class DoctorReaders : public ::testing::Test {
protected:
    DoctorReaders() {
        checked_.config = &config_;
        checked_.service.name = "axiscal";
        checked_.service.user = ::geteuid();
        checked_.service.groups = {::getegid()};
        config_.state_directory = scratch_.path();
        config_.publish.destination = scratch_.path();
        config_.publish.group = ::getgrgid(::getegid())->gr_name;
    }
    /// The finding that speaks of the group.
    [[nodiscard]] Finding finding(mode_t folder) const {
        EXPECT_EQ(::chmod(scratch_.path().c_str(), folder), 0);
        for (const Finding& found : check_share(checked_, 0))
            if (found.what.find("group " + config_.publish.group) != std::string::npos)
                return found;
        return {Health::note, "none", "", ""};
    }
    testing::ScratchFolder scratch_;
    StationConfig config_;
    CheckedSystem checked_;
};

TEST_F(DoctorReaders, ReadWhatTheFolderPassesItsGroupTo) {
    EXPECT_EQ(finding(02750).health, Health::good);
}

TEST_F(DoctorReaders, DoNotReadWhatTheFolderKeeps) {
    for (const mode_t mode : {0750U, 02700U, 02710U, 02740U}) {
        const Finding found = finding(mode);
        EXPECT_EQ(found.health, Health::broken) << std::oct << mode;
        EXPECT_EQ(found.mend, "sudo chgrp " + config_.publish.group + " " + scratch_.path() +
                                  " && sudo chmod g+rxs " + scratch_.path());
    }
}

TEST_F(DoctorReaders, ThatDoNotExistAreTold) {
    config_.publish.group = "no-such-group-here";
    EXPECT_EQ(finding(02750).mend, "sudo addgroup no-such-group-here");
}

TEST_F(DoctorReaders, AreNotAskedForWhereNoneAreNamed) {
    config_.publish.group.clear();
    EXPECT_EQ(finding(0750).area, "none");
}

} // namespace
} // namespace axiscal::doctor_readers_test
