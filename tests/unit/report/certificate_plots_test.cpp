// The plots of a certificate show each curve in its colour where the numbers at the axes say that
// it lies, and nowhere else. Nothing of the code that lays plots out is asked where that is.

#include "acquisition/documents/pdf/plots.hpp"
#include "pdf_tools.hpp"
#include "synthetic_certificate.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <optional>
#include <utility>

namespace axiscal::certificate_plots_test {
namespace {

using testing::ScratchFolder;

constexpr PageBox plot_box{60, 80, 420, 260};
constexpr int pixels_a_point = 3;    ///< the thinnest curve is then more than two pixels wide
constexpr double largest_sign = 3.4; ///< points: from the middle of an arrow to its corner
constexpr double near = 1.5;         ///< points: half a line, and how well a number's place is read

/// One pixel as poppler paints it.
struct Paint {
    int red = 0, green = 0, blue = 0;
};
/// Of Okabe and Ito, as docs and legend name them: blue is forward, vermilion backward.
constexpr Paint blue{0, 114, 178}, vermilion{213, 94, 0};

using Curve = std::vector<PagePoint>;

/// What stands in a page: the places of each colour, and the numbers beside the axes.
class DrawnPage {
public:
    explicit DrawnPage(const std::string& pdf)
        : words_{test::words_of(pdf)} {
        std::istringstream ppm{test::output_of(
            "pdftoppm -r " + std::to_string(72 * pixels_a_point) + " '" + pdf + "'")};
        std::string magic;
        int depth = 0;
        ppm >> magic >> width_ >> height_ >> depth;
        ppm.get();
        pixels_.assign(std::istreambuf_iterator<char>{ppm}, {});
    }

    /// Middles of the numbers in [low, high] that stand left of the frame (`rows`), or below it.
    [[nodiscard]] std::vector<std::pair<double, PagePoint>>
    numbers(bool rows, double low, double high) const {
        double lowest = 0;
        for (const auto& word : words_)
            if (value_of(word)) lowest = std::max(lowest, word.top);
        std::vector<std::pair<double, PagePoint>> found;
        for (const auto& word : words_) {
            const auto value = value_of(word);
            if (value && (word.top < lowest - 1) == rows && *value >= low && *value <= high)
                found.push_back(
                    {*value, {(word.left + word.right) / 2, (word.top + word.bottom) / 2}});
        }
        std::ranges::sort(found, {}, &std::pair<double, PagePoint>::first);
        return found;
    }

    /// Everything of this colour, undiluted, between two heights.
    [[nodiscard]] Curve painted(Paint colour, double top, double bottom) const {
        Curve places;
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x) {
                const PagePoint at{(x + 0.5) / pixels_a_point, (y + 0.5) / pixels_a_point};
                if (at.y > top && at.y < bottom && is(x, y, colour)) places.push_back(at);
            }
        return places;
    }

private:
    static std::optional<double> value_of(const test::Word& word) {
        std::string text = word.text;
        if (text.starts_with("\u2212")) text.replace(0, 3, "-");
        double value = 0;
        const char* const end = text.data() + text.size();
        const auto read = std::from_chars(text.data(), end, value);
        return read.ec == std::errc{} && read.ptr == end ? std::optional{value} : std::nullopt;
    }
    [[nodiscard]] bool is(int x, int y, Paint colour) const {
        constexpr int diluted = 40;
        const auto part = [&](int channel) {
            const auto place = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                                    static_cast<std::size_t>(x));
            return static_cast<int>(
                static_cast<unsigned char>(pixels_[place + static_cast<std::size_t>(channel)]));
        };
        return std::abs(part(0) - colour.red) < diluted &&
               std::abs(part(1) - colour.green) < diluted &&
               std::abs(part(2) - colour.blue) < diluted;
    }

    std::vector<test::Word> words_;
    int width_ = 0, height_ = 0;
    std::string pixels_;
};

/// Where the numbers of both axes put a point.
class Scale {
public:
    /// `low`, `high`: of the numbers of the rows that belong to this panel.
    Scale(const DrawnPage& page, double low, double high)
        : columns_{page.numbers(false, -1e9, 1e9)}
        , rows_{page.numbers(true, low, high)} {}
    [[nodiscard]] bool is_read() const { return columns_.size() > 2 && rows_.size() > 2; }
    [[nodiscard]] PagePoint at(double x, double y) const {
        const auto& [left, left_at] = columns_.front();
        const auto& [right, right_at] = columns_.back();
        const auto& [bottom, bottom_at] = rows_.front();
        const auto& [top, top_at] = rows_.back();
        return {left_at.x + (x - left) / (right - left) * (right_at.x - left_at.x),
                bottom_at.y + (y - bottom) / (top - bottom) * (top_at.y - bottom_at.y)};
    }
    [[nodiscard]] double top() const { return rows_.back().second.y; }
    [[nodiscard]] double bottom() const { return rows_.front().second.y; }

private:
    std::vector<std::pair<double, PagePoint>> columns_, rows_;
};

double distance(PagePoint a, PagePoint b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

double distance_to(const Curve& curve, PagePoint at) {
    double least = distance(curve.front(), at);
    for (std::size_t i = 1; i < curve.size(); ++i) {
        const PagePoint a = curve[i - 1], b = curve[i];
        const double along =
            ((at.x - a.x) * (b.x - a.x) + (at.y - a.y) * (b.y - a.y)) / std::pow(distance(a, b), 2);
        const double share = std::clamp(along, 0.0, 1.0);
        least =
            std::min(least, distance(at, {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)}));
    }
    return least;
}

/// How many places lie off the curve.
long strays(const Curve& painted, const Curve& curve) {
    return std::ranges::count_if(
        painted, [&](PagePoint at) { return distance_to(curve, at) > largest_sign + near; });
}

/// How many corners of the curve have no paint.
long bare_corners(const Curve& painted, const Curve& curve) {
    return std::ranges::count_if(curve, [&](PagePoint corner) {
        return std::ranges::none_of(painted,
                                    [&](PagePoint at) { return distance(at, corner) < near; });
    });
}

/// The curve is drawn there, and would be missed if it were turned over in either direction.
void expect_drawn(const Curve& painted, const Curve& curve, const Scale& scale) {
    EXPECT_EQ(bare_corners(painted, curve), 0);
    EXPECT_EQ(strays(painted, curve), 0) << "of " << painted.size();
    Curve left_for_right = curve, top_for_bottom = curve;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        left_for_right[i].y = curve[curve.size() - 1 - i].y; // the columns are evenly spaced
        top_for_bottom[i].y = scale.top() + scale.bottom() - curve[i].y;
    }
    for (const Curve& mirrored : {left_for_right, top_for_bottom}) {
        EXPECT_GT(strays(painted, mirrored), static_cast<long>(painted.size() / 4));
        EXPECT_GE(bare_corners(painted, mirrored), 4);
    }
}

class CertificatePlots : public ::testing::Test {
protected:
    template <class Draw> DrawnPage page_of(const Draw& draw) {
        PdfDocument document{"plot", "plot", "2026-01-01T00:00:00Z"};
        draw(document.canvas());
        document.end_page();
        const auto bytes = document.finish();
        EXPECT_TRUE(bytes.has_value());
        return DrawnPage{test::write_pdf(folder_, bytes.value_or(""))};
    }
    ScratchFolder folder_;
};

constexpr double middle_mm = 488.917; ///< of the targets of the simulated axis

/// Forward a ramp from -9.53 to +9.53 um, backward half as steep and 8 um lower: they never meet.
double ramp_um(Direction direction, double target_mm) {
    const double rise = 0.02 * (target_mm - middle_mm);
    return direction == Direction::positive ? rise : rise / 2 - 8;
}

TEST_F(CertificatePlots, DeviationsOfARampRiseFromLowerLeftToUpperRight) {
    test::Truth truth = test::synthetic_truth(1);
    truth.deviation_mm = [](const PlannedPoint& point, double target_mm) {
        return ramp_um(point.direction, target_mm) / 1000;
    };
    RunRecord run = test::synthetic_run();
    run.points.clear();
    test::add_points(run, truth);
    const Certificate certificate = test::certificate_of(std::move(run));
    const DrawnPage page =
        page_of([&](Canvas& canvas) { draw_deviation_plot(canvas, plot_box, certificate); });
    const Scale scale{page, -1e9, 1e9};
    ASSERT_TRUE(scale.is_read());
    const auto curve_of = [&](Direction direction) {
        Curve curve;
        for (const double target_mm : certificate.deviations.targets())
            curve.push_back(scale.at(target_mm, ramp_um(direction, target_mm)));
        return curve;
    };
    const Curve forward = curve_of(Direction::positive), backward = curve_of(Direction::negative);
    ASSERT_GT(forward.front().y, forward.back().y + 50) << "lower left, upper right";
    ASSERT_LT(forward.front().x, forward.back().x - 200);
    expect_drawn(page.painted(blue, scale.top(), scale.bottom()), forward, scale);
    expect_drawn(page.painted(vermilion, scale.top(), scale.bottom()), backward, scale);
}

EnvironmentTrace ramp_of(const std::string& name, ChannelKind kind, double begin, double rise) {
    EnvironmentTrace trace{name, kind, Medium::air, {}, {}};
    for (int i = 0; i <= 10; ++i) {
        trace.seconds.push_back(i * 300);
        trace.values.push_back(begin + rise * i / 10);
    }
    return trace;
}

/// Two sensors of air temperature, one that rises by 4 K and one that falls by 1 K, and a pressure
/// that falls by 20 hPa.
TEST_F(CertificatePlots, EnvironmentIsDrawnWhereTimeAndValueAreInThePanelOfItsKind) {
    const EnvironmentTrace rising = ramp_of("near", ChannelKind::temperature, 20, 4),
                           falling = ramp_of("far", ChannelKind::temperature, 21.2, -1),
                           pressure = ramp_of("column", ChannelKind::pressure, 101500, -2000);
    const std::vector<EnvironmentPanel> panels{
        {paper_of(ChannelKind::temperature, Medium::air), {&rising, &falling}},
        {paper_of(ChannelKind::pressure, Medium::air), {&pressure}}};
    const DrawnPage page =
        page_of([&](Canvas& canvas) { draw_environment_plot(canvas, plot_box, panels); });
    const Scale celsius{page, 10, 40}, hectopascal{page, 900, 1100};
    ASSERT_TRUE(celsius.is_read() && hectopascal.is_read());
    ASSERT_LT(celsius.bottom(), hectopascal.top()) << "one panel above the other";
    const auto expect_trace = [&](const EnvironmentTrace& trace, Paint colour, const Scale& scale,
                                  double units) {
        SCOPED_TRACE(trace.channel);
        Curve curve;
        for (std::size_t i = 0; i < trace.values.size(); ++i)
            curve.push_back(scale.at(trace.seconds[i] / 60, trace.values[i] * units));
        expect_drawn(page.painted(colour, scale.top(), scale.bottom()), curve, scale);
    };
    expect_trace(rising, blue, celsius, 1);
    expect_trace(falling, vermilion, celsius, 1);
    expect_trace(pressure, blue, hectopascal, 0.01);
}

} // namespace
} // namespace axiscal::certificate_plots_test
