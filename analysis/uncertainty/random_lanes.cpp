#include "analysis/uncertainty/random_lanes.hpp"

#include "analysis/uncertainty/lane_inline.hpp"

namespace axiscal {
namespace {

std::uint64_t splitmix64(std::uint64_t& state) {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

void uniform_baseline(RandomLanes& random, double* q, std::size_t count) {
    lane::uniform<16>(random, q, count);
}
AXISCAL_LANE_AVX2 void uniform_avx2(RandomLanes& random, double* q, std::size_t count) {
    lane::uniform<32>(random, q, count);
}
void normal_baseline(double* q, std::size_t count) {
    lane::normal(q, count);
}
AXISCAL_LANE_AVX2 void normal_avx2(double* q, std::size_t count) {
    lane::normal(q, count);
}

} // namespace

RandomLanes::RandomLanes(std::uint64_t seed) {
    for (std::size_t l = 0; l < lanes; ++l)
        for (auto& word : state)
            word[l] = splitmix64(seed);
}

LaneCode fastest_lane_code() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) return LaneCode::avx2;
#endif
    return LaneCode::baseline;
}

void fill_uniform(RandomLanes& random, double* q, std::size_t count, LaneCode code) {
    (code == LaneCode::avx2 ? uniform_avx2 : uniform_baseline)(random, q, count);
}

void to_normal(double* q, std::size_t count, LaneCode code) {
    (code == LaneCode::avx2 ? normal_avx2 : normal_baseline)(q, count);
}

} // namespace axiscal
