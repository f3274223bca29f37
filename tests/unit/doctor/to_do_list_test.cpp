// What a look from outside adds to the station's list.
#include "tools/axiscal/doctor/to_do_list.hpp"

#include <gtest/gtest.h>

namespace axiscal::to_do_list_test {
namespace {

ToDo laser_is_gone() {
    return {"instrument/laser",     ToDoRank::look,
            ToDoSource::instrument, "laser: unavailable",
            "2026-11-21T10:00:00Z", "Check plug and power.",
            "axiscal devices",      {}};
}

TEST(DoctorsList, LeavesOutWhatIsGood) {
    EXPECT_TRUE(with_findings({}, {{Health::good, "clock", "a time server sets it", ""}}).empty());
}

TEST(DoctorsList, PutsWhatIsBrokenBeforeWhatTheStationHasALookAt) {
    const auto list = with_findings(
        {laser_is_gone()}, {{Health::broken, "papers", "the font is not installed", "apt install"},
                            {Health::note, "disk", "1 GB is left", "make room"}});
    ASSERT_EQ(list.size(), 3U);
    EXPECT_EQ(list[0].source, ToDoSource::doctor);
    EXPECT_EQ(list[1].id, "instrument/laser");
    EXPECT_EQ(list[2].source, ToDoSource::disk);
}

TEST(DoctorsList, GivesTheStationsEntryTheWayToMendItThatOnlyTheDoctorSees) {
    const auto list = with_findings(
        {laser_is_gone()}, {{Health::broken, "wire", "\"laser\" may not be opened: no rights",
                             "sudo adduser axiscal plugdev, then restart it"}});
    ASSERT_EQ(list.size(), 1U);
    EXPECT_EQ(list[0].seen, "laser: unavailable");
    EXPECT_EQ(list[0].command, "sudo adduser axiscal plugdev");
    EXPECT_EQ(list[0].undo, "sudo deluser axiscal plugdev");
}

TEST(DoctorsList, DoesNotRepeatTheStationsSentence) {
    ToDo port{"trigger/port",
              ToDoRank::look,
              ToDoSource::trigger,
              "the address is taken",
              {},
              "'axiscal doctor' tries the port and says how to mend it.",
              "axiscal doctor",
              {}};
    EXPECT_EQ(with_findings({port}, {{Health::note, "port",
                                      "axiscald reports about its trigger: the address is taken",
                                      "axiscal status"}})
                  .size(),
              1U);
}

TEST(DoctorsList, NamesWhatUndoesAnOrderToTheSystem) {
    const auto list = with_findings({}, {{Health::note, "share", "axiscal-publish does not run",
                                          "sudo systemctl enable --now axiscal-publish"}});
    ASSERT_EQ(list.size(), 1U);
    EXPECT_EQ(list[0].undo, "sudo systemctl disable --now axiscal-publish");
    EXPECT_NE(to_do_text(list).find("undo: sudo systemctl disable --now axiscal-publish"),
              std::string::npos);
}

TEST(DoctorsList, IsReadFromTheTopOnATerminal) {
    EXPECT_EQ(to_do_text({}), "To do        nothing\n");
    EXPECT_EQ(to_do_text({laser_is_gone()}),
              "To do\n"
              "  LOOK  laser: unavailable (since 2026-11-21T10:00:00Z)\n"
              "        -> Check plug and power.\n"
              "           axiscal devices\n");
}

} // namespace
} // namespace axiscal::to_do_list_test
