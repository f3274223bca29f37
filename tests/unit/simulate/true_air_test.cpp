// Expected numbers: tests/reference/air_index.csv (published NIST values; computed oracle rows).
#include "tests/support/source_dir.hpp"
#include "true_air.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

namespace axiscal::simulate::true_air_test {
namespace {

struct Row {
    std::string model, status;
    double nm = 0, t = 0, p = 0, co2 = 0, n = 0;
    std::string humidity, vapour;
};

std::vector<Row> rows() {
    std::ifstream file{test::source_dir() + "/tests/reference/air_index.csv"};
    std::vector<Row> table;
    for (std::string line; std::getline(file, line);) {
        std::vector<std::string> cells;
        std::istringstream text{line};
        for (std::string cell; std::getline(text, cell, ',');)
            cells.push_back(cell);
        if (cells.size() < 10 || line.starts_with('#') || cells[0] == "model") continue;
        table.push_back({cells[0], cells.back(), std::stod(cells[1]), std::stod(cells[2]),
                         std::stod(cells[3]), std::stod(cells[6]), std::stod(cells[7]), cells[4],
                         cells[5]});
    }
    return table;
}

double index_of(const Row& row) {
    TrueAir air{Temperature::celsius(row.t), pascal(row.p), percent(0), row.co2};
    if (!row.vapour.empty())
        return 1 + refractivity(air, pascal(std::stod(row.vapour)), nm(row.nm));
    air.humidity = percent(std::stod(row.humidity));
    return 1 + refractivity(air, nm(row.nm));
}

TEST(TrueAir, AgreesWithThePublishedValuesAtShopFloorConditions) {
    int compared = 0;
    for (const Row& row : rows()) {
        const bool shop_floor = row.status == "published" && std::abs(row.t - 20) <= 5 &&
                                row.nm > 600 && row.nm < 650 && row.p > 90e3 && row.p < 110e3;
        if (!shop_floor) continue;
        EXPECT_NEAR(index_of(row), row.n, 3e-8) << row.t << " C " << row.humidity << " %";
        ++compared;
    }
    EXPECT_GE(compared, 6);
}

TEST(TrueAir, IsTheEquationOfBoenschAndPotulski) {
    int compared = 0;
    for (const Row& row : rows()) {
        if (row.model != "bonsch_potulski") continue;
        EXPECT_NEAR(index_of(row), row.n, 1e-12);
        ++compared;
    }
    EXPECT_EQ(compared, 3);
}

TEST(TrueAir, VapourPressureIsNearTheSteamTables) {
    // IAPWS-IF97 region 4: 3536.58941 Pa at 300 K; 0.1 % of it moves n by 1e-10 at 50 % RH.
    EXPECT_NEAR(saturation_vapour_pressure(Temperature::kelvin(300)).in(pascal), 3536.58941, 3.6);
}

} // namespace
} // namespace axiscal::simulate::true_air_test
