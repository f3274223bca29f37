#pragma once
// Seeded run records with every field filled, and a comparison of every bit, field by field,
// that knows nothing of rows and columns.

#include "analysis/record/run_attachments.hpp"
#include "analysis/record/run_record.hpp"

#include <bit>
#include <boost/pfr.hpp>
#include <optional>
#include <random>
#include <type_traits>
#include <variant>
#include <vector>

namespace axiscal::testing {

class RandomRun {
public:
    explicit RandomRun(unsigned seed)
        : random_{seed} {}

    RunRecord header() {
        RunRecord run;
        run.run_id = text(), run.software_version = text(), run.station = text();
        run.station_config = text() + "\n[a]\nb = \"0.5 mm\"\n" + text();
        run.config_hash = text(), run.boot_id.text = text();
        run.opened = tie();
        fill_plan(run.plan);
        run.laser = {text(),   length(), number(), pick(2) == 0 ? 1 : -1,
                     length(), length(), length()};
        run.material.coefficient = Expansion::from_si(number());
        if (pick(2) == 0) run.material.standard_uncertainty = Expansion::from_si(number());
        run.material.feedback = text();
        run.material.form = pick(2) == 0 ? ExpansionForm::exact : ExpansionForm::first_order;
        run.air = {pick(2) == 0 ? AirFormula::edlen : AirFormula::ciddor, number(),
                   Duration{integer()}};
        if (pick(3) > 0) fill_uncertainty(run.uncertainty.emplace());
        if (pick(2) == 0) fill_tolerances(run.tolerances.emplace());
        for (int i = pick(3); i > 0; --i)
            run.standards.push_back(text() + std::to_string(i)); // each once
        boost::pfr::for_each_field(run.statements, [&](std::string& field) { field = text(); });
        for (int i = pick(4); i > 0; --i) {
            auto& instrument = run.instruments.emplace_back();
            boost::pfr::for_each_field(instrument, [&](std::string& field) { field = text(); });
        }
        for (int i = pick(6); i > 0; --i)
            run.channels.push_back({pick(1000), text(), text(), text(),
                                    static_cast<ChannelKind>(pick(6)), static_cast<Medium>(pick(3)),
                                    number()});
        for (int i = 0; i < pick(4); ++i)
            fill_calibration(run.calibrations.emplace_back(), i);
        if (pick(2) == 0) fill_rotary(run.rotary.emplace());
        run.kind = static_cast<TestKind>(pick(6));
        return run;
    }

    /// Of a run of this kind; a circular test brings its set-up with the first block.
    RunAttachments attachments(TestKind kind) {
        RunAttachments beside;
        if (pick(2) == 0) fill_alignment(beside.alignment.emplace());
        if (kind == TestKind::drift)
            beside.setup =
                DriftSetup{Duration{integer()}, Duration{integer()}, length(), pick(2) == 0};
        if (kind == TestKind::probing) {
            auto& probing = beside.setup.emplace<ProbingRecord>();
            probing.feed_mm_per_min = number(), probing.probe = text();
            probing.signal_path = text();
            for (int i = pick(9); i > 0; --i)
                probing.touches.push_back({{number(), number(), number()},
                                           pick(2) == 0,
                                           length(),
                                           {length(), length(), length()}});
        }
        if (kind == TestKind::straightness)
            fill_straightness_test(beside.setup.emplace<StraightnessSetup>());
        if (kind == TestKind::squareness) fill_squareness(beside.setup.emplace<SquarenessSetup>());
        if (pick(2) == 0) beside.eve_source = text();
        return beside;
    }

    DatumRecord datum() {
        return {text() + std::to_string(++datums_), // each once
                time(),
                length(),
                length(),
                static_cast<std::uint32_t>(random_()),
                length(),
                number(),
                pick(1000),
                static_cast<std::uint16_t>(pick(65536)),
                random_()};
    }

    PointRecord point(int step) {
        PointRecord point;
        point.step = step;
        point.sequence = static_cast<std::uint16_t>(pick(65536));
        point.planned = {step, pick(99), direction(), pick(9)};
        point.origin = static_cast<TriggerOrigin>(pick(3));
        point.triggered_at = time(), point.window_begin = time(), point.window_end = time();
        point.reading = length(), point.spread = length();
        point.slope_um_per_s = number();
        point.n = pick(100'000);
        point.approach_travel = length();
        point.datum_id = text();
        point.live_deviation = length();
        std::vector<WindowSample> samples;
        for (int i = pick(40); i > 0; --i)
            samples.push_back({time(), number(), random_()});
        point.samples = std::move(samples);
        return point;
    }

    std::vector<EnvironmentReading> environment() {
        std::vector<EnvironmentReading> readings;
        for (int i = pick(5); i > 0; --i) {
            later_ += pick(1'000'000);
            readings.push_back({pick(9), monotonic_from_ns(later_), number()});
        }
        return readings;
    }

    EventRecord event() {
        return {static_cast<EventKind>(pick(11)),
                time(),
                integer(),
                text(),
                static_cast<Fault>(pick(static_cast<int>(Fault::internal) + 1)),
                static_cast<std::uint16_t>(pick(65536))};
    }

    ClockTie tie() { return {time(), integer(), time()}; }
    int pick(int below) { return static_cast<int>(random_() % static_cast<unsigned>(below)); }

    /// Any finite double: small, huge, subnormal, whole, negative zero.
    double number() {
        switch (pick(8)) {
        case 0: return -0.0;
        case 1: return static_cast<double>(pick(2000) - 1000);
        case 2: return 5e-324;
        case 3: return -1.7976931348623157e308;
        default: break;
        }
        const double any = std::bit_cast<double>(random_());
        return any - any == 0 ? any : 0.1; // not NaN or infinity
    }

private:
    std::string text() {
        static constexpr std::string_view letters[] = {"a", "Ö", "\"", "'", "\n",
                                                       " ", "±", "7",  ""};
        std::string words;
        for (int i = pick(12); i > 0; --i)
            words += letters[pick(9)];
        return words;
    }
    std::int64_t integer() { return static_cast<std::int64_t>(random_()); }
    MonotonicTime time() { return monotonic_from_ns(integer()); }
    Length length() { return Length::from_si(number()); }
    Direction direction() { return pick(2) == 0 ? Direction::negative : Direction::positive; }

    void fill_calibration(ChannelCalibration& calibration, int channel) {
        calibration.channel = channel;
        calibration.certificate_number = text(), calibration.calibrated_on = text();
        calibration.due_on = text(), calibration.coverage = number();
        if (pick(2) == 0) calibration.expanded_uncertainty = number();
        if (pick(2) == 0) calibration.expanded_uncertainty_per_m = number();
        for (int i = pick(4); i > 0; --i)
            calibration.corrections.push_back({number(), number()});
    }
    void fill_plan(RunPlan& plan) {
        plan.axis_kind = pick(2) == 0 ? AxisKind::rotary : AxisKind::linear;
        plan.cycle = pick(2) == 0 ? CycleKind::step : CycleKind::standard;
        plan.pass = text(), plan.remark = text();
        for (int i = pick(20); i > 0; --i)
            plan.targets.push_back(length());
        plan.approaches = pick(9);
        plan.bidirectional = pick(2) == 0;
        plan.interval = length();
        if (pick(2) == 0) plan.seed = random_();
        plan.overrun = length(), plan.near_tolerance = length(), plan.datum = length();
        for (int i = pick(30); i > 0; --i)
            plan.points.push_back({pick(99), pick(99), direction(), pick(9)});
    }

    void fill_rotary(RotarySetup& rotary) {
        rotary.method = pick(2) == 0 ? AngleMethod::polygon : AngleMethod::indexing_table;
        rotary.step_deg = number(), rotary.arm = length(), rotary.range_deg = number();
        rotary.turn_time = Duration{integer()};
        rotary.by_hand = pick(2) == 0, rotary.certificate_with_axis = pick(2) == 0;
        rotary.run_out = text();
        for (int i = pick(9); i > 0; --i)
            rotary.deviations_arcsec.push_back(number());
    }

    void fill_straightness(StraightnessSetup& setup) {
        setup.method = static_cast<StraightnessMethod>(pick(2));
        setup.across = text(), setup.sign = pick(2) == 0 ? 1 : -1;
        setup.factor = number(), setup.resolution = length();
        setup.mirror = static_cast<MirrorPosition>(pick(2));
        setup.reversal_of = text(), setup.base = length();
        setup.angle_resolution = Angle::from_si(number());
        setup.place = text();
        StraightnessStatement& stated = setup.uncertainty;
        stated.factor_U = perhaps<Ratio>(), stated.factor_limit = perhaps<Ratio>();
        if (pick(2) == 0) stated.mirror_limit_um_per_m2 = number();
        stated.angle_U = perhaps<Angle>(), stated.base_U = perhaps<Length>();
        stated.factor_k = number(), stated.angle_k = number(), stated.base_k = number();
        stated.eve = perhaps<Length>(), stated.eve_angle = perhaps<Angle>();
    }

    void fill_straightness_test(StraightnessSetup& setup) {
        fill_straightness(setup);
        if (pick(2) == 0) return;
        fill_line(setup.reversal.emplace());
        setup.reversal->run_id = setup.reversal_of; // a file has it once
    }

    void fill_line(RecordedLine& line) {
        line.run_id = text(), line.axis = text(), line.across = text();
        line.readings = pick(1000), line.scatter = length();
        for (int i = pick(9); i > 0; --i)
            line.rows.push_back({length(), length(), perhaps<Length>()});
    }

    void fill_squareness(SquarenessSetup& setup) {
        fill_straightness(setup.optics);
        fill_line(setup.first);
        setup.square = static_cast<SquarePosition>(pick(2));
        setup.stated = {perhaps<Angle>(), perhaps<Angle>(), perhaps<Angle>(), number(),
                        perhaps<Angle>()};
        if (pick(2) == 0) return;
        OtherSquare& other = setup.other.emplace();
        fill_line(other.first), fill_line(other.second);
    }

    void fill_tolerances(ToleranceRecord& set) {
        set.name = text(), set.source = text(), set.unit = text();
        set.rule = static_cast<DecisionRule>(pick(4));
        set.to_be_checked = pick(2) == 0;
        for (int i = pick(5); i > 0; --i)
            set.limits.push_back(
                {text(), pick(2) == 0 ? std::optional{number()} : std::nullopt, number()});
    }

    void fill_alignment(AlignmentRecord& alignment) {
        alignment.began_utc_ns = integer(), alignment.ended_utc_ns = integer();
        alignment.instrument = text(), alignment.serial = text();
        alignment.travel = length(), alignment.reached = length();
        alignment.readings = pick(1000), alignment.lost = pick(9), alignment.restarts = pick(9);
        if (pick(2) == 0)
            alignment.far = FarRest{length(), length(), length(), length(), pick(99), pick(2) == 0};
        alignment.spot_offset = perhaps<Length>();
        for (int i = pick(9); i > 0; --i)
            alignment.places.push_back(
                {length(), length(), pick(999), number(), number(), number()});
    }

    template <class Amount> std::optional<Amount> perhaps() {
        if (pick(2) == 0) return std::nullopt;
        return Amount::from_si(number());
    }

    void fill_uncertainty(UncertaintySetup& setup) {
        setup.device_U = {perhaps<Length>(), perhaps<Ratio>()};
        setup.device_k = number();
        setup.device_width = {perhaps<Length>(), perhaps<Ratio>()};
        setup.misalignment = perhaps<Length>();
        setup.misalignment_angle = perhaps<Angle>();
        setup.temperature_width = perhaps<TemperatureDifference>();
        setup.expansion_width = perhaps<Expansion>();
        setup.eve = perhaps<Length>();
        setup.eve_model = pick(2) == 0 ? EveModel::difference : EveModel::mean;
        for (int i = pick(4); i > 0; --i) // each parameter once
            setup.targets.push_back({text() + std::to_string(i), length()});
    }

    std::mt19937_64 random_;
    std::int64_t later_ = 0;
    int datums_ = 0;
};

template <class T> struct IsVector : std::false_type {};
template <class T> struct IsVector<std::vector<T>> : std::true_type {};
template <> struct IsVector<WindowSamples> : std::true_type {};
template <class T> struct IsOptional : std::false_type {};
template <class T> struct IsOptional<std::optional<T>> : std::true_type {};

template <class T> struct IsVariant : std::false_type {};
template <class... T> struct IsVariant<std::variant<T...>> : std::true_type {};

template <class T> bool same_bits(const T& a, const T& b) {
    if constexpr (std::is_floating_point_v<T>) {
        return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
    } else if constexpr (requires { a.si(); }) {
        return same_bits(a.si(), b.si());
    } else if constexpr (IsVector<T>::value) {
        bool same = a.size() == b.size();
        for (std::size_t i = 0; same && i < a.size(); ++i)
            same = same_bits(a.begin()[i], b.begin()[i]);
        return same;
    } else if constexpr (IsOptional<T>::value) {
        return a.has_value() == b.has_value() && (!a || same_bits(*a, *b));
    } else if constexpr (IsVariant<T>::value) {
        return a.index() == b.index() &&
               std::visit([&b]<class Held>(
                              const Held& held) { return same_bits(held, std::get<Held>(b)); },
                          a);
    } else if constexpr (std::is_aggregate_v<T>) {
        const auto left = boost::pfr::structure_tie(a), right = boost::pfr::structure_tie(b);
        return [&]<std::size_t... i>(std::index_sequence<i...>) {
            return (same_bits(std::get<i>(left), std::get<i>(right)) && ...);
        }
        (std::make_index_sequence<boost::pfr::tuple_size_v<T>>{});
    } else {
        return a == b;
    }
}

} // namespace axiscal::testing
