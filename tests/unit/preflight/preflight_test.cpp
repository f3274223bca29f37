// Each pre-flight check with what it lets pass and what it stops.
#include "acquisition/preflight/preflight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

namespace axiscal::preflight_test {
namespace {

using namespace std::chrono_literals;

/// A shop where every check holds, at 20 minutes; a test spoils one thing.
class Preflight : public ::testing::Test {
protected:
    Preflight() {
        for (const char* name : {"laser", "air", "material"}) {
            InstrumentConfig one;
            one.name = name;
            one.certificate_number = "C-1";
            one.due_on = "2026-11-21";
            config.instruments.push_back(one);
        }
        config.axis.dead_path = mm(120);
        config.axis.material.coefficient = per_kelvin(11.5e-6);
        config.axis.material.standard_uncertainty = per_kelvin(0.5e-6);
        read([](double) { return 21.0; }, [](double) { return 20.5; }, [](double) { return 20.6; });
        stand([](double) { return 0.0; });
    }

    using Course = std::function<double(double minutes)>;
    /// Twenty minutes of readings, one a second.
    void read(const Course& air, const Course& left, const Course& right) {
        logs.clear();
        for (const Course& course : {air, left, right}) {
            auto log = std::make_unique<SensorLog>(20min);
            for (int second = 0; second <= 1200; ++second)
                log->take(Sample{0, at(second), course(second / 60.0)});
            logs.push_back(std::move(log));
        }
    }
    /// The laser's reading over the last minute, in micrometres.
    void stand(const std::function<double(double seconds)>& course) {
        samples.clear();
        for (int k = 0; k <= 6000; ++k) {
            const double seconds = k / 100.0;
            samples.emplace_back(0, at(1140 + seconds), course(seconds) * 1e-6);
        }
    }
    static MonotonicTime at(double seconds) { return MonotonicTime{from_seconds(seconds)}; }

    PreflightFacts facts() {
        PreflightFacts facts{config, at(1200), "2026-11-21", "as found", "none", {},
                             {},     {},       {},           {},         {}};
        facts.in_use = {"laser", "air", "material"};
        const Medium media[] = {Medium::air, Medium::material, Medium::material};
        const char* names[] = {"air/temperature", "material/left", "material/right"};
        for (std::size_t k = 0; k < logs.size(); ++k)
            facts.sensors.push_back(
                {names[k], ChannelKind::temperature, media[k], true, "good", logs[k].get()});
        facts.laser_age = 10ms;
        facts.laser_samples = samples;
        return facts;
    }
    static const PreflightRecord& named(const std::vector<PreflightRecord>& checks,
                                        const std::string& name) {
        return *std::ranges::find(checks, name, &PreflightRecord::name);
    }
    /// Only this check fails, and its sentence holds these words.
    void
    expect_failure(const PreflightFacts& of, const std::string& name, const std::string& words) {
        const auto checks = judge_preflight(of);
        for (const PreflightRecord& check : checks)
            EXPECT_EQ(check.passed, check.name != name) << check.name << ": " << check.verdict;
        EXPECT_NE(named(checks, name).verdict.find(words), std::string::npos)
            << named(checks, name).verdict;
    }

    StationConfig config;
    std::vector<std::unique_ptr<SensorLog>> logs;
    std::vector<Sample> samples;
};

TEST_F(Preflight, TheEnvironmentIsHeldToTheLimitsThatAreStated) {
    config.environment.air_temperature = {18, 25, {}};
    config.environment.material_temperature = {{}, 20.55, {}};
    expect_failure(facts(), "environment",
                   "material/right shows 20.6 degC, 20.55 degC at most are allowed");
    config.environment.material_temperature.high = 21;
    EXPECT_TRUE(named(judge_preflight(facts()), "environment").passed);
    config.environment.air_temperature.high = 20.9;
    expect_failure(facts(), "environment",
                   "air/temperature shows 21 degC, 18 degC to 20.9 degC are allowed");
    config.environment.air_temperature = {21.1, {}, {}};
    expect_failure(facts(), "environment", "21.1 degC and more are allowed");
}

// 0.02 K a minute are 1.2 K an hour.
TEST_F(Preflight, TheEnvironmentMayChangeSoMuchInAnHour) {
    read([](double minutes) { return 20.0 + 0.02 * minutes; }, [](double) { return 20.5; },
         [](double) { return 20.6; });
    config.preflight.soak_change = kelvin(1);
    config.environment.air_temperature.change_per_hour = 1.3;
    EXPECT_TRUE(named(judge_preflight(facts()), "environment").passed);
    config.environment.air_temperature.change_per_hour = 1.1;
    expect_failure(facts(), "environment",
                   "air/temperature changes by 1.2 K an hour, 1.1 K are allowed");
    config.environment.change_window = 30min; // the sensor has been read for 20 minutes
    EXPECT_TRUE(named(judge_preflight(facts()), "environment").passed) << "not judged yet";
}

TEST_F(Preflight, AllHoldInAShopAtRest) {
    for (const PreflightRecord& check : judge_preflight(facts()))
        EXPECT_TRUE(check.passed) << check.name << ": " << check.verdict;
    EXPECT_EQ(open_objections(judge_preflight(facts())), "");
}

TEST_F(Preflight, AnInstrumentThatIsAwayIsNamed) {
    auto some = facts();
    some.unavailable = {"air"};
    expect_failure(some, "instruments", "air is not available");
    auto stale = facts();
    stale.sensors[1].fresh = false;
    stale.sensors[1].quality = "stale";
    expect_failure(stale, "instruments", "material/left gives no fresh reading (stale)");
    auto blind = facts();
    blind.laser_age.reset();
    expect_failure(blind, "instruments", "the laser");
}

// 0.2 K in 10 minutes are allowed: 0.03 K/min is too much, 0.015 K/min is not.
TEST_F(Preflight, ASensorThatStillWarmsUpIsNamedWithItsSlope) {
    read([](double) { return 21.0; }, [](double minutes) { return 18 + 0.03 * minutes; },
         [](double) { return 18.5; });
    expect_failure(facts(), "soak", "material/left changes by 0.3 K in 10 min");
    read([](double) { return 21.0; }, [](double minutes) { return 18 + 0.015 * minutes; },
         [](double) { return 18.5; });
    EXPECT_TRUE(named(judge_preflight(facts()), "soak").passed);
}

TEST_F(Preflight, ASensorReadForTooShortATimeIsToldHowLong) {
    auto young = facts();
    SensorLog log{20min};
    for (int second = 1080; second <= 1200; ++second)
        log.take(Sample{0, at(second), 20.5});
    young.sensors[2].log = &log;
    expect_failure(young, "soak", "material/right has been read for 2 min of 10 min");
}

// A sensor that is asked each 110 s: its first reading in the window comes 70 s after the
// beginning, its newest is 90 s old.
TEST_F(Preflight, ASensorThatIsAskedSeldomSpansTheWindowToo) {
    auto slow = facts();
    SensorLog log{12min};
    for (int second = 10; second <= 1200; second += 110)
        log.take(Sample{0, at(second), 20.5 + 0.0001 * second});
    slow.sensors[2].log = &log;
    EXPECT_TRUE(named(judge_preflight(slow), "soak").passed)
        << named(judge_preflight(slow), "soak").verdict;
    SensorLog warming{12min};
    for (int second = 10; second <= 1200; second += 110)
        warming.take(Sample{0, at(second), 20.5 + 0.0005 * second});
    slow.sensors[2].log = &warming;
    expect_failure(slow, "soak", "material/right changes by 0.3 K in 10 min");
}

TEST_F(Preflight, ASensorThatWasAwayBeginsItsSoakAnew) {
    auto torn = facts();
    SensorLog log{12min};
    for (int second = 0; second <= 1200; ++second)
        if (second <= 700 || second >= 1080) log.take(Sample{0, at(second), 20.5});
    torn.sensors[2].log = &log;
    expect_failure(torn, "soak", "material/right has been read for 2 min of 10 min");
}

TEST_F(Preflight, MaterialSensorsThatDisagreeAreNamed) {
    read([](double) { return 21.0; }, [](double) { return 20.0; }, [](double) { return 23.5; });
    expect_failure(facts(), "sensors", "material/right shows 3.5 K more than material/left");
}

TEST_F(Preflight, MaterialSensorsThatShowTheSameAreNotOneAlone) {
    read([](double) { return 21.0; }, [](double) { return 20.5; }, [](double) { return 20.5; });
    EXPECT_EQ(named(judge_preflight(facts()), "sensors").verdict,
              "The material sensors agree within 0 K.");
}

TEST_F(Preflight, TheScalesSensorNeedNotAgreeWithThoseOfTheMachine) {
    read([](double) { return 21.0; }, [](double) { return 20.5; }, [](double) { return 24.5; });
    config.axis.scale.emplace();
    PreflightFacts by_scale = facts();
    EXPECT_FALSE(named(judge_preflight(by_scale), "sensors").passed);
    by_scale.sensors.back().on_scale = true;
    EXPECT_TRUE(named(judge_preflight(by_scale), "sensors").passed);
    EXPECT_EQ(named(judge_preflight(by_scale), "strength").verdict,
              "The scale does not report the strength of its signal.");
}

TEST_F(Preflight, TheStandingScaleIsNotCalledALaser) {
    config.axis.scale.emplace();
    stand([](double seconds) { return 0.05 * seconds; });
    expect_failure(facts(), "drift", "Let scale and machine warm up.");
    samples.erase(samples.begin(), samples.begin() + 4000);
    expect_failure(facts(), "drift", "The scale has been read for less than 30 s");
}

// The air swings by 0.2 K with a period of three minutes; a sensor that hangs in it shows 90 %.
TEST_F(Preflight, AMaterialSensorThatFollowsTheAirIsNamed) {
    const auto swing = [](double minutes) { return 0.1 * std::sin(minutes * 2.1); };
    read([&](double minutes) { return 21 + swing(minutes); },
         [&](double minutes) { return 20.5 + 0.9 * swing(minutes); }, [](double) { return 20.6; });
    expect_failure(facts(), "contact", "material/left shows 90 % of each change");
    read([&](double minutes) { return 21 + swing(minutes); },
         [&](double minutes) { return 20.5 + 0.2 * swing(minutes); }, [](double) { return 20.6; });
    EXPECT_TRUE(named(judge_preflight(facts()), "contact").passed);
}

// Sensors that are read once a second, both of which hang in the air.
TEST_F(Preflight, ContactThatCannotBeJudgedIsSaidToBeSo) {
    const auto swing = [](double minutes) { return 0.1 * std::sin(minutes * 2.1); };
    const auto follows = [&](double minutes) { return 20.5 + swing(minutes); };
    read([&](double minutes) { return 21 + swing(minutes); }, follows, follows);
    EXPECT_FALSE(named(judge_preflight(facts()), "contact").passed);
    config.preflight.soak_window = 5s;
    PreflightRecord contact = named(judge_preflight(facts()), "contact");
    EXPECT_TRUE(contact.passed);
    EXPECT_EQ(contact.verdict,
              "Not judged for material/left; material/right: within 5 s (preflight.soak_window) "
              "there are fewer than 10 readings of it or of the air.");
    config.preflight.soak_window = 0s;
    contact = named(judge_preflight(facts()), "contact");
    EXPECT_TRUE(contact.passed);
    EXPECT_EQ(contact.verdict, "Not asked: preflight.soak_window is 0.");
}

TEST_F(Preflight, AWeakSignalIsToldIfTheLaserTellsIt) {
    auto weak = facts();
    SensorLog log{20min, SensorLog::Keep::lowest};
    for (int second = 0; second <= 1200; ++second)
        log.take(Sample{0, at(second), second == 700 ? 12.0 : 80.0});
    weak.strengths.push_back(
        {"laser/strength", ChannelKind::strength, Medium::none, true, "good", &log});
    expect_failure(weak, "strength", "The weakest recent signal was 12 %; at least ");
}

// 1 um in 30 s is allowed.
TEST_F(Preflight, ADriftOfTheStandingAxisIsMeasured) {
    stand([](double seconds) { return 0.05 * seconds; });
    expect_failure(facts(), "drift", "drifts by 1.5 um in 30 s");
    stand([](double seconds) { return seconds < 50 ? 0.0 : 20'000.0; });
    expect_failure(facts(), "drift", "The axis moved");
    samples.erase(samples.begin(), samples.begin() + 4000);
    expect_failure(facts(), "drift", "less than 30 s");
}

TEST_F(Preflight, ALaserThatIsAskedSeldomSpansTheDriftWindowToo) {
    samples.clear();
    for (int second = 1160; second <= 1200; second += 8)
        samples.emplace_back(0, at(second), 0.01e-6 * second);
    EXPECT_TRUE(named(judge_preflight(facts()), "drift").passed)
        << named(judge_preflight(facts()), "drift").verdict;
}

TEST_F(Preflight, ACoefficientWithoutUncertaintyIsNotEnough) {
    config.axis.material.standard_uncertainty.reset();
    expect_failure(facts(), "expansion", "has no stated uncertainty");
    config.uncertainty.emplace().expansion_width = per_kelvin(1e-6);
    EXPECT_TRUE(named(judge_preflight(facts()), "expansion").passed);
}

TEST_F(Preflight, TheStateOfTheMachineIsAskedFor) {
    auto silent = facts();
    silent.state.clear();
    expect_failure(silent, "compensation", "not stated");
    auto odd = facts();
    odd.state = "fine";
    expect_failure(odd, "compensation", "\"fine\"");
    auto table = facts();
    table.control_compensation.clear();
    expect_failure(table, "compensation", "Which compensation");
}

TEST_F(Preflight, ADaemonFromWhichTheBootIdIsHiddenIsWarnedAndMayMeasure) {
    auto hidden = facts();
    hidden.boot_known = false;
    const auto checks = judge_preflight(hidden);
    EXPECT_EQ(open_objections(checks), "");
    const PreflightRecord computer = named(checks, "computer");
    EXPECT_TRUE(computer.passed && computer.warning);
    EXPECT_NE(computer.verdict.find("ProcSubset=pid"), std::string::npos) << computer.verdict;
    EXPECT_FALSE(named(judge_preflight(facts()), "computer").warning);
}

TEST_F(Preflight, AComputerThatMayFallAsleepIsWarnedOf) {
    auto refused = facts();
    refused.may_sleep = "systemd-inhibit: Failed to inhibit: Access denied";
    const auto checks = judge_preflight(refused);
    EXPECT_EQ(open_objections(checks), "");
    const PreflightRecord computer = named(checks, "computer");
    EXPECT_TRUE(computer.passed && computer.warning);
    for (const char* words : {"Access denied", "polkit"})
        EXPECT_NE(computer.verdict.find(words), std::string::npos) << computer.verdict;
}

// A battery that is dead: "in date" in 1970, and a certificate that ran out a year behind.
TEST_F(Preflight, AClockThatCannotBeRightIsToldWithWhatProvesIt) {
    EXPECT_TRUE(named(judge_preflight(facts()), "clock").passed);
    auto reset = facts();
    reset.today = "1970-01-02";
    expect_failure(reset, "clock", "1970-01-02");
    config.instruments[0].calibrated_on = "2026-03-02";
    auto behind = facts();
    behind.today = "2026-03-01";
    expect_failure(behind, "clock",
                   "2026-03-02 is already past, because laser was calibrated then");
    behind.today = "2026-03-02";
    EXPECT_TRUE(named(judge_preflight(behind), "clock").passed);
    config.instruments[1].channels.emplace_back().channel = "pressure";
    config.instruments[1].channels.back().calibration.calibrated_on = "2026-03-05";
    expect_failure(behind, "clock", "air/pressure was calibrated then");
    auto unused = behind;
    unused.in_use = {"laser"};
    EXPECT_TRUE(named(judge_preflight(unused), "clock").passed) << "nobody needs it";
    auto stored = facts();
    stored.newest_run = "bay-20261122T080000Z-X";
    stored.newest_run_day = "2026-11-22";
    expect_failure(stored, "clock", "run bay-20261122T080000Z-X was measured then");
    stored.today = "2026-11-22";
    EXPECT_TRUE(named(judge_preflight(stored), "clock").passed);
}

TEST_F(Preflight, AnInstrumentOutOfDateIsNamed) {
    config.instruments[1].due_on = "2026-11-20";
    expect_failure(facts(), "certificates", "air was due for calibration on 2026-11-20");
    config.instruments[2].channels.emplace_back().channel = "contact 1";
    config.instruments[2].channels.back().calibration.due_on = "2026-11-19";
    expect_failure(facts(), "certificates",
                   "material/contact 1 was due for calibration on 2026-11-19");
    config.instruments[2].channels.clear();
    auto others = facts();
    others.in_use = {"laser", "material"};
    EXPECT_TRUE(named(judge_preflight(others), "certificates").passed) << "nobody needs it";
}

TEST_F(Preflight, AShopWithoutCertificatesIsWarnedAndMayMeasure) {
    for (InstrumentConfig& instrument : config.instruments)
        instrument.certificate_number.clear(), instrument.due_on.clear();
    const auto checks = judge_preflight(facts());
    EXPECT_EQ(open_objections(checks), "");
    const PreflightRecord certificates = named(checks, "certificates");
    EXPECT_TRUE(certificates.passed && certificates.warning);
    for (const char* words : {"laser has no certificate_number", "air has no certificate_number",
                              "material has no certificate_number", "is not known"})
        EXPECT_NE(certificates.verdict.find(words), std::string::npos) << certificates.verdict;
    config.instruments[1].due_on = "2026-11-20"; // a date alone is past all the same
    expect_failure(facts(), "certificates", "air was due for calibration on 2026-11-20");
    auto others = facts();
    others.in_use.clear();
    EXPECT_FALSE(named(judge_preflight(others), "certificates").warning) << "nobody needs them";
}

TEST_F(Preflight, ACertificateOfAnotherInstrumentIsNone) {
    PreflightFacts seen = facts();
    seen.serials = {{"laser", "4712"}, {"air", "E24638"}};
    EXPECT_TRUE(named(judge_preflight(seen), "certificates").passed) << "none is stated";
    config.instruments[0].serial = "4711";
    expect_failure(seen, "certificates",
                   "laser has the serial number 4712, and the station file states serial = "
                   "\"4711\" with its certificate");
    for (const char* same : {"4712", "004712", " 47-12 "}) {
        config.instruments[0].serial = same;
        EXPECT_TRUE(named(judge_preflight(seen), "certificates").passed) << same;
    }
    config.instruments[0].serial = "4711";
    seen.in_use = {"air", "material"};
    EXPECT_TRUE(named(judge_preflight(seen), "certificates").passed) << "nobody needs it";
}

TEST_F(Preflight, AnAirSensorThatRepeatsItsLastReadingIsNamed) {
    read([](double minutes) { return minutes < 8 ? 21 + 0.01 * minutes : 21.08; },
         [](double) { return 20.5; }, [](double) { return 20.6; });
    expect_failure(facts(), "instruments",
                   "air repeats its last reading: no figure changed for 10 min, unplug it and "
                   "plug it in again");
    config.preflight.soak_window = 5min;
    EXPECT_TRUE(named(judge_preflight(facts()), "instruments").passed) << "too short to tell";
}

TEST_F(Preflight, ADeadPathOfNothingIsDoubted) {
    const auto doubted = [this] {
        const auto checks = judge_preflight(facts());
        const auto found = std::ranges::find(checks, "dead_path", &PreflightRecord::name);
        return found != checks.end() && found->passed && found->warning;
    };
    EXPECT_FALSE(doubted());
    config.axis.dead_path = Length{};
    EXPECT_TRUE(doubted());
    config.axis.scale.emplace();
    EXPECT_FALSE(doubted()) << "no beam, no dead path";
}

TEST_F(Preflight, AnOverrideNeedsAKnownNameAndAReason) {
    config.instruments[1].due_on = "2026-11-20";
    auto checks = judge_preflight(facts());
    EXPECT_FALSE(override_checks(checks, {{"weather", "rain"}}));
    EXPECT_FALSE(override_checks(checks, {{"certificates", "  "}}));
    ASSERT_NE(open_objections(checks), "");
    ASSERT_TRUE(override_checks(
        checks, {{"certificates", "the new one is on its way"}, {"soak", "not needed: it holds"}}));
    EXPECT_EQ(open_objections(checks), "");
    EXPECT_EQ(named(checks, "certificates").override_reason, "the new one is on its way");
    EXPECT_EQ(named(checks, "soak").override_reason, "") << "a reason for what holds is not kept";
}

/// The same shop with a ballbar at rest beside its circle.
class CircularPreflight : public Preflight {
protected:
    CircularPreflight() {
        config.circular.emplace();
        config.circular->setup.machine_alpha_per_K = 11.5e-6;
        rest([](double) { return 0.0; });
    }
    /// The bar's reading over the last minute, in micrometres.
    void rest(const std::function<double(double seconds)>& course) {
        bar = SensorLog{2min};
        for (int k = 0; k <= 600; ++k)
            bar.take(Sample{0, at(1140 + k / 10.0), 1.5e-3 + course(k / 10.0) * 1e-6});
    }
    PreflightFacts facts() {
        PreflightFacts facts = Preflight::facts();
        facts.circular = true;
        facts.laser_age.reset(); // there is none
        facts.laser_samples = {};
        facts.bar_age = 5ms;
        facts.bar = &bar;
        return facts;
    }
    SensorLog bar{2min};
};

TEST_F(CircularPreflight, AllHoldWithoutALaser) {
    for (const PreflightRecord& check : judge_preflight(facts()))
        EXPECT_TRUE(check.passed && !check.warning) << check.name << ": " << check.verdict;
}

TEST_F(CircularPreflight, TheBarTakesTheLasersPlace) {
    auto silent = facts();
    silent.bar_age = 5s;
    expect_failure(silent, "instruments", "the ballbar gives no fresh reading");
    rest([](double seconds) { return 0.1 * seconds; }); // 3 um in 30 s; 1 um is allowed
    expect_failure(facts(), "drift", "standing ballbar drifts by 3 um in 30 s");
    rest([](double seconds) { return seconds > 50 ? 400.0 : 0.0; });
    expect_failure(facts(), "drift", "Let the machine rest beside the circle");
}

TEST_F(CircularPreflight, ABarOutOfItsRangeAtRestIsNotJudgedForDrift) {
    bar = SensorLog{2min};
    const auto checks = judge_preflight(facts());
    EXPECT_TRUE(named(checks, "drift").passed);
    EXPECT_NE(named(checks, "drift").verdict.find("Not judged"), std::string::npos);
}

TEST_F(CircularPreflight, WithoutACoefficientFAndDStandAsMeasured) {
    config.circular->setup.machine_alpha_per_K.reset();
    EXPECT_TRUE(named(judge_preflight(facts()), "expansion").warning);
    config.circular->setup.machine_alpha_per_K = 11.5e-6;
    config.axis.material.standard_uncertainty.reset();
    expect_failure(facts(), "expansion", "circular.uncertainty.machine_expansion_width");
    config.circular->setup.uncertainty.machine_alpha_width_per_K = 2e-6;
    EXPECT_TRUE(named(judge_preflight(facts()), "expansion").passed);
}

EveFacts eve_of_a_long_test() {
    EveFacts eve;
    eve.run_id = "shop-20261121T100000Z-X-drift";
    eve.order = "'axiscal drift'";
    eve.lasted = 30min;
    eve.run_takes = 12min;
    eve.rest = mm(900);
    eve.beam = mm(950);
    eve.longest_beam = mm(1050);
    return eve;
}

TEST_F(Preflight, ADriftTestTellsItsLengthAndItsPlace) {
    PreflightFacts with = facts();
    EXPECT_FALSE(with.eve);
    const auto without = judge_preflight(with);
    EXPECT_EQ(std::ranges::find(without, "eve", &PreflightRecord::name), without.end());
    with.eve = eve_of_a_long_test();
    const auto checks = judge_preflight(with);
    EXPECT_TRUE(named(checks, "eve").passed);
    EXPECT_EQ(named(checks, "eve").verdict,
              "E_VE is of the drift test shop-20261121T100000Z-X-drift: 30 min, the axis at 900 mm; "
              "the run takes 12 min or more.");
    with.eve->lasted = 12min;
    EXPECT_TRUE(named(judge_preflight(with), "eve").passed);
    with.eve->angle = true;
    EXPECT_NE(named(judge_preflight(with), "eve").verdict.find("at 900 deg"), std::string::npos);
}

TEST_F(Preflight, ADriftTestShorterThanTheRunSaysTooLittleOfIt) {
    PreflightFacts with = facts();
    with.eve = eve_of_a_long_test();
    with.eve->lasted = 20s;
    with.eve->run_takes = 109s;
    expect_failure(with, "eve",
                   "20 s, the axis at 900 mm. The test is too short: the run takes 109 s");
    expect_failure(with, "eve", "'axiscal drift' with --duration \"2 min\" or more");
    with.eve->lasted = 12min - 1ms;
    with.eve->run_takes = 12min;
    expect_failure(with, "eve", "too short");
}

TEST_F(Preflight, ADriftTestNearTheInterferometerSaysTooLittleOfAFarRun) {
    PreflightFacts with = facts();
    with.eve = eve_of_a_long_test();
    with.eve->beam = mm(525);
    EXPECT_TRUE(named(judge_preflight(with), "eve").passed);
    with.eve->beam = mm(524);
    expect_failure(with, "eve",
                   "the beam was 524 mm long, but the run's beam is up to 1050 mm");
    with.eve->beam.reset(); // a scale, a ballbar
    EXPECT_TRUE(named(judge_preflight(with), "eve").passed);
}

} // namespace
} // namespace axiscal::preflight_test
