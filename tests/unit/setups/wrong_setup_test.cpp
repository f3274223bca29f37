// Whether a whole station names what a person did wrong, before the certificate, and suspects
// nobody who did all right.
//
//   AXISCAL_MACHINES=N   N machines of each mistake and ten times as many good ones (tools/soak
//                        setups plays 100 and 1000)
//   AXISCAL_SEED=N       machines from that seed on
#include "tests/support/asked_seed.hpp"
#include "tests/unit/setups/measured_setup.hpp"

#include <gtest/gtest.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

namespace axiscal::setups_test {
namespace {

/// What the station must say, and where it is cheapest to mend.
struct Expected {
    Mistake mistake;
    std::vector<std::string> where; ///< "arm", "point", "end"
    std::vector<std::string> any_of;
};

const std::vector<Expected>& expectations() {
    static const std::vector<Expected> all{
        {Mistake::inch_for_millimetre, {"point"}, {"inch"}},
        {Mistake::reversed_sign, {"point"}, {"the sign is turned"}},
        {Mistake::exchanged_directions, {"point"}, {"exchanges forward and backward"}},
        {Mistake::loose_optic, {"end"}, {"Probably an optic moved"}},
        {Mistake::no_dead_path, {"arm"}, {"dead_path: axis.dead_path is 0 mm"}},
        {Mistake::sensor_in_air,
         {"arm", "end"},
         {"It reads the air", "a material sensor hangs in the air"}},
        {Mistake::cold_machine, {"arm"}, {"soak: material"}},
        {Mistake::wrong_expansion, {"end"}, {"the expansion coefficient of the station file"}},
        {Mistake::no_overrun, {"point"}, {"the program has no overrun"}},
        {Mistake::one_step_late, {"point"}, {"the one before: one step late", "the target before"}},
        {Mistake::other_instrument, {"arm"}, {"with its certificate"}},
        {Mistake::frozen_air, {"arm"}, {"repeats its last reading"}}};
    return all;
}

bool is_named(const Expected& expected, const std::vector<Said>& said) {
    return std::ranges::any_of(said, [&](const Said& one) {
        return std::ranges::any_of(
                   expected.where,
                   [&](const std::string& where) { return one.where.starts_with(where); }) &&
               std::ranges::any_of(expected.any_of, [&](const std::string& words) {
                   return one.words.find(words) != std::string::npos;
               });
    });
}

int machines() {
    const char* text = std::getenv("AXISCAL_MACHINES"); // NOLINT(concurrency-mt-unsafe): one thread
    return text == nullptr ? 2 : std::stoi(text);
}

std::string text_of(const std::vector<Said>& said) {
    std::string text;
    for (const Said& one : said)
        text += "\n  " + one.where + ": " + one.words;
    return text.empty() ? "\n  nothing" : text;
}

class WrongSetup : public ::testing::Test {
protected:
    void SetUp() override {
        spdlog::set_level(spdlog::level::err);
    } // each machine is a day of notes
    std::uint64_t first_seed = axiscal::testing::asked_seed().value_or(1);
};

TEST_F(WrongSetup, IsNamedBeforeTheCertificate) {
    ASSERT_GE(machines(), 1) << "AXISCAL_MACHINES: without a machine nothing is named";
    int kinds_named = 0;
    for (const Expected& expected : expectations()) {
        int named = 0;
        for (int i = 0; i < machines(); ++i) {
            RandomMachine machine{first_seed + static_cast<std::uint64_t>(i), expected.mistake};
            const auto said = measure(machine);
            if (is_named(expected, said))
                ++named;
            else
                std::cout << name_of(expected.mistake) << ", machine " << first_seed + i << ":"
                          << text_of(said) << "\n";
        }
        std::cout << name_of(expected.mistake) << ": " << named << " of " << machines() << "\n";
        kinds_named += named * 100 >= machines() * 95;
    }
    EXPECT_GE(kinds_named, 11) << "of twelve kinds, each in 95 of 100 machines";
}

TEST_F(WrongSetup, IsNotSeenInAGoodOne) {
    const int good = 10 * machines();
    ASSERT_GE(good, 1);
    int suspected = 0;
    for (int i = 0; i < good; ++i) {
        RandomMachine machine{first_seed + static_cast<std::uint64_t>(i), Mistake::none};
        const auto said = measure(machine);
        if (said.empty()) continue;
        ++suspected;
        std::cout << "machine " << first_seed + i << ":" << text_of(said) << "\n";
    }
    std::cout << "good: " << suspected << " of " << good << " suspected\n";
    EXPECT_LE(suspected * 100, good) << "one in a hundred";
}

} // namespace
} // namespace axiscal::setups_test
