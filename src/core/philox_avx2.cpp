// SPDX-License-Identifier: MIT
//
// A vector holds one of the counter's four words for four blocks, in the low halves of its 64-bit
// lanes: there the multiplication of the rounds wants it and leaves its product. High halves hold
// what they may, since nothing reads them. A round is two products, two shifts and four exclusive
// ors for four blocks.
//
// Blocks stand in the lanes in the order 0, 2, 1, 3, so that one unpacking brings the two numbers
// of blocks 0 and 1, another those of 2 and 3, side by side.
#include "core/philox_avx2.hpp"

#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#define STIPPLE_AVX2 [[gnu::target("avx2")]]

namespace stipple {
namespace {

constexpr std::size_t rounds = 10;

/// The key of each round in all lanes, low word and high word.
struct Keys {
    __m256i low[rounds];
    __m256i high[rounds];
};

STIPPLE_AVX2 Keys keys_of(std::uint64_t seed) {
    Keys keys;
    auto low = static_cast<std::uint32_t>(seed);
    auto high = static_cast<std::uint32_t>(seed >> 32);
    for (std::size_t r = 0; r < rounds; ++r) {
        keys.low[r] = _mm256_set1_epi64x(low);
        keys.high[r] = _mm256_set1_epi64x(high);
        low += 0x9E3779B9;
        high += 0xBB67AE85;
    }
    return keys;
}

/// The four words of four blocks.
struct Words {
    __m256i w0, w1, w2, w3;
};

STIPPLE_AVX2 inline Words round(const Words& w, __m256i low, __m256i high) {
    const __m256i p0 = _mm256_mul_epu32(w.w0, _mm256_set1_epi64x(0xD2511F53));
    const __m256i p2 = _mm256_mul_epu32(w.w2, _mm256_set1_epi64x(0xCD9E8D57));
    return {_mm256_xor_si256(_mm256_srli_epi64(p2, 32), _mm256_xor_si256(w.w1, low)), p2,
            _mm256_xor_si256(_mm256_srli_epi64(p0, 32), _mm256_xor_si256(w.w3, high)), p0};
}

/// The 53 high bits as a double in [0, 1), as to_unit gives it. Bits laid under an exponent are a
/// sum of powers of two: 2^20 + high 2^-32, and 1/2 + 21 bits of low 2^-53; what is not wanted of
/// it goes by subtraction, and nothing is rounded.
STIPPLE_AVX2 inline __m256d to_unit(__m256i low, __m256i high) {
    const __m256d base = _mm256_set1_pd(0x1p20);
    const __m256i under = _mm256_blend_epi32(high, _mm256_castpd_si256(base), 0b10101010);
    const __m256i tail = _mm256_srli_epi64(_mm256_slli_epi64(low, 32), 43);
    const __m256i half = _mm256_or_si256(tail, _mm256_castpd_si256(_mm256_set1_pd(0.5)));
    const __m256d most = _mm256_sub_pd(_mm256_castsi256_pd(under), _mm256_set1_pd(0x1p20 + 0.5));
    return _mm256_add_pd(most, _mm256_castsi256_pd(half));
}

STIPPLE_AVX2 inline void store(const Words& w, double* out) {
    const __m256d even = to_unit(w.w0, w.w1);
    const __m256d odd = to_unit(w.w2, w.w3);
    _mm256_storeu_pd(out, _mm256_unpacklo_pd(even, odd));
    _mm256_storeu_pd(out + 4, _mm256_unpackhi_pd(even, odd));
}

}  // namespace

bool has_philox_avx2() {
    static const bool has = __builtin_cpu_supports("avx2");
    return has;
}

STIPPLE_AVX2 void fill_philox_avx2(std::uint64_t seed, std::uint64_t stream, std::uint64_t pair,
                                   double* out, std::size_t count) {
    const Keys keys = keys_of(seed);
    const __m256i low = _mm256_set1_epi64x(static_cast<std::uint32_t>(stream));
    const __m256i high = _mm256_set1_epi64x(static_cast<std::uint32_t>(stream >> 32));
    const auto first = static_cast<long long>(pair);
    __m256i pairs = _mm256_add_epi64(_mm256_set1_epi64x(first), _mm256_setr_epi64x(0, 2, 1, 3));
    const __m256i four = _mm256_set1_epi64x(4);
    for (std::size_t k = 0; k < count; k += philox_avx2_step) {
        const __m256i next = _mm256_add_epi64(pairs, four);
        Words a{pairs, _mm256_srli_epi64(pairs, 32), low, high};
        Words b{next, _mm256_srli_epi64(next, 32), low, high};
        for (std::size_t r = 0; r < rounds; ++r) {
            a = round(a, keys.low[r], keys.high[r]);
            b = round(b, keys.low[r], keys.high[r]);
        }
        store(a, out + k);
        store(b, out + k + 8);
        pairs = _mm256_add_epi64(next, four);
    }
}

}  // namespace stipple

#else

namespace stipple {

bool has_philox_avx2() { return false; }

void fill_philox_avx2(std::uint64_t, std::uint64_t, std::uint64_t, double*, std::size_t) {}

}  // namespace stipple

#endif
