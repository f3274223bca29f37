// What the doctor makes of what it reads.
#include "tools/axiscal/doctor/judges.hpp"

#include <gtest/gtest.h>
#include <linux/magic.h>

namespace axiscal::judges_test {
namespace {

Health worst(const std::vector<Finding>& findings) {
    Health health = Health::good;
    for (const Finding& finding : findings)
        health = std::max(health, finding.health);
    return health;
}

ClockReading good_clock() {
    return {true, 0.01, "tsc", false, 2026};
}

TEST(Doctor, ClockKeptByATimeServerIsGood) {
    EXPECT_EQ(worst(judge_clock(good_clock())), Health::good);
}

TEST(Doctor, ClockWithoutATimeServerIsWorthANote) {
    ClockReading clock = good_clock();
    clock.synchronised = false;
    EXPECT_EQ(worst(judge_clock(clock)), Health::note);
    clock = good_clock();
    clock.largest_error_s = 16; // what the kernel assumes after hours without a server
    EXPECT_EQ(worst(judge_clock(clock)), Health::note);
}

TEST(Doctor, DateBeforeTheFirstReleaseIsWrong) {
    ClockReading clock = good_clock();
    clock.year = 1970;
    EXPECT_EQ(worst(judge_clock(clock)), Health::broken);
}

TEST(Doctor, ClockThatDoesNotTellSamplesApartIsBroken) {
    ClockReading clock = good_clock();
    clock.ran_back = true;
    EXPECT_EQ(worst(judge_clock(clock)), Health::broken);
    clock = good_clock();
    clock.source = "jiffies";
    EXPECT_EQ(worst(judge_clock(clock)), Health::broken);
}

TEST(Doctor, OnlyADiskOfThisComputerKeepsPoints) {
    const auto health = [](long kind) { return worst(judge_disk({"/f", kind, 1e12, true})); };
    EXPECT_EQ(health(EXT4_SUPER_MAGIC), Health::good);
    EXPECT_EQ(health(TMPFS_MAGIC), Health::broken);
    EXPECT_EQ(health(NFS_SUPER_MAGIC), Health::broken);
    EXPECT_EQ(health(0xFE534D42), Health::broken); // SMB2_SUPER_MAGIC
    EXPECT_EQ(health(MSDOS_SUPER_MAGIC), Health::broken);
    EXPECT_EQ(health(OVERLAYFS_SUPER_MAGIC), Health::note);
    EXPECT_EQ(health(0x12345678), Health::note);
}

TEST(Doctor, FullDiskIsBrokenAndANearlyFullOneANote) {
    const auto health = [](double free_bytes, bool names = true) {
        return worst(judge_disk({"/f", EXT4_SUPER_MAGIC, free_bytes, names}));
    };
    EXPECT_EQ(health(1e6), Health::broken);
    EXPECT_EQ(health(1e9), Health::note);
    EXPECT_EQ(health(1e10), Health::good);
    EXPECT_EQ(health(1e10, false), Health::broken);
}

TEST(Doctor, PortIsFreeOrTheDaemonsAndElseSomebodyElses) {
    const auto health = [](PortTrial trial, bool daemon) {
        return judge_port_trial({"the port", "127.0.0.1", 1502, trial, daemon}).health;
    };
    EXPECT_EQ(health(PortTrial::free, false), Health::good);
    EXPECT_EQ(health(PortTrial::taken, true), Health::good);
    EXPECT_EQ(health(PortTrial::taken, false), Health::broken);
    EXPECT_EQ(health(PortTrial::free, true), Health::broken);
    EXPECT_EQ(health(PortTrial::no_address, false), Health::broken);
    EXPECT_EQ(health(PortTrial::no_right, false), Health::note);
}

TEST(Doctor, PortThatOnlyRootMayTakeIsNotGoodForTheService) {
    PortReading port{"the port", "127.0.0.1", 502, PortTrial::free, false, true};
    EXPECT_EQ(judge_port_trial(port).health, Health::note);
    EXPECT_NE(judge_port_trial(port).mend.find("CAP_NET_BIND_SERVICE"), std::string::npos);
    port.port = 1024; // ip(7): the first that everybody may take
    EXPECT_EQ(judge_port_trial(port).health, Health::good);
    port = {"the port", "127.0.0.1", 502, PortTrial::taken, true, true};
    EXPECT_EQ(judge_port_trial(port).health, Health::good); // the service was given the right
}

TEST(Doctor, MissingModuleIsBrokenOnlyWhereAnInstrumentNeedsIt) {
    EXPECT_EQ(judge_module("ds2490", "x", ModuleState::missing, "screw").health, Health::broken);
    EXPECT_EQ(judge_module("ds2490", "x", ModuleState::missing, "").health, Health::note);
    EXPECT_EQ(judge_module("ds2490", "x", ModuleState::available, "screw").health, Health::good);
}

TEST(Doctor, DebiansKernelWithoutCountersIsSaid) {
    const Finding finding = judge_module("counter", "x", ModuleState::missing, "");
    EXPECT_NE(finding.what.find("Debian's stock kernel does not build"), std::string::npos);
}

TEST(Doctor, WhateverIsNotGoodSaysHowToMendIt) {
    std::vector<Finding> all = judge_clock({false, 0, "jiffies", true, 1970});
    for (const auto& more :
         {judge_disk({"/f", TMPFS_MAGIC, 0, true}), judge_disk({"/f", 0x12345678, 1e9, false})})
        all.insert(all.end(), more.begin(), more.end());
    for (const PortTrial trial :
         {PortTrial::taken, PortTrial::no_right, PortTrial::no_address, PortTrial::failed})
        all.push_back(judge_port_trial({"the port", "127.0.0.1", 502, trial, false}));
    all.push_back(judge_module("ds2490", "x", ModuleState::missing, "screw"));
    for (const Finding& finding : all) {
        EXPECT_NE(finding.health, Health::good) << finding.what;
        EXPECT_FALSE(finding.mend.empty()) << finding.what;
        EXPECT_EQ(finding.mend.find('\n'), std::string::npos) << finding.mend;
    }
}

} // namespace
} // namespace axiscal::judges_test
