// Whom the files of a state directory belong to, as the doctor sees them. As root and as anybody.
#include "tools/axiscal/doctor/doctor.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal::doctor_owners_test {
namespace {

class DoctorOwners : public ::testing::Test {
protected:
    DoctorOwners() {
        std::string name = (std::filesystem::temp_directory_path() / "owners-XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
        service_.name = "axiscal";
        service_.user = ::geteuid() + 1; // owns nothing here, is in no group
    }
    ~DoctorOwners() override { std::filesystem::remove_all(folder_); }

    void add(const std::string& name, mode_t mode) {
        const std::filesystem::path path = folder_ + "/" + name;
        std::filesystem::create_directories(path.parent_path());
        std::ofstream{path} << "x";
        ASSERT_EQ(::chmod(path.c_str(), mode), 0);
    }
    [[nodiscard]] std::vector<Finding> findings() const { return check_owners(folder_, service_); }

    std::string folder_;
    Account service_;
};

TEST_F(DoctorOwners, FilesThatTheServiceMayWriteAreNoFinding) {
    ASSERT_EQ(::chmod(folder_.c_str(), 0777), 0);
    add("lock", 0666);
    EXPECT_TRUE(findings().empty());
}

TEST_F(DoctorOwners, FilesOfAnotherUserAreNamedWithTheLineThatMendsThem) {
    add("lock", 0640);
    add("token", 0644);
    const auto found = findings();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].health, Health::broken);
    EXPECT_NE(found[0].what.find("lock"), std::string::npos) << found[0].what;
    EXPECT_NE(found[0].what.find("token"), std::string::npos) << found[0].what;
    EXPECT_EQ(found[0].mend.find("sudo chown -R axiscal: " + folder_), 0U) << found[0].mend;
}

TEST_F(DoctorOwners, FilesBelowAreFoundAndManyAreCounted) {
    add("outbox/publisher.lock", 0600);
    std::filesystem::permissions(folder_ + "/outbox", std::filesystem::perms::all);
    EXPECT_NE(findings().at(0).what.find("outbox/publisher.lock"), std::string::npos);
    for (const char* name : {"a", "b", "c", "d"})
        add(name, 0600);
    EXPECT_NE(findings().at(0).what.find(" and 2 more"), std::string::npos) << findings()[0].what;
}

TEST_F(DoctorOwners, FilesThatTheServiceMadeForReadingAloneAreItsOwn) {
    service_.user = ::geteuid();
    add("runs/x.axiscal", 0400);
    EXPECT_TRUE(findings().empty());
}

TEST_F(DoctorOwners, FindingStandsAmongThoseOfTheDisk) {
    ASSERT_EQ(::chmod(folder_.c_str(), 0777), 0);
    add("lock", 0640);
    StationConfig config;
    config.state_directory = folder_;
    CheckedSystem checked;
    checked.config = &config;
    checked.service = service_;
    std::string told;
    for (const Finding& finding : check_disk(checked))
        told += finding.what + "\n";
    EXPECT_NE(told.find("may not write lock"), std::string::npos) << told;
}

TEST_F(DoctorOwners, LinksAreLeftAlone) {
    std::filesystem::create_symlink("/nowhere", folder_ + "/published");
    EXPECT_TRUE(findings().empty());
}

} // namespace
} // namespace axiscal::doctor_owners_test
