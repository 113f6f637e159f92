// Four doubles at once, in the compiler's own vector type (one AVX register; two SSE registers on
// machines without AVX).
#pragma once

namespace otter_nav::tracker {

constexpr int kLanes = 4;
using Pack = double __attribute__((vector_size(kLanes * sizeof(double))));
using PackBits = long long __attribute__((vector_size(kLanes * sizeof(long long))));

inline Pack broadcast(double value) {
  return Pack{value, value, value, value};
}

inline Pack abs(Pack x) {
  return x < 0.0 ? -x : x;
}

// Rows become columns.
inline void transpose(Pack& a, Pack& b, Pack& c, Pack& d) {
  const Pack ab_low = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Pack ab_high = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Pack cd_low = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Pack cd_high = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
  c = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
  d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

// Sine and cosine to a few units in the last place for |x| up to 1e6 (Cody and Waite's reduction to
// an eighth turn, then Taylor's polynomials).
inline void sinCos(Pack x, Pack& sine, Pack& cosine) {
  constexpr double kRounder = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to an integer
  constexpr double kTwoOverPi = 0.63661977236758134308;
  constexpr double kHalfPiHigh = 1.57079632673412561417;
  constexpr double kHalfPiMiddle = 6.07710050630396597660e-11;
  constexpr double kHalfPiLow = 2.02226624879595063154e-21;
  const Pack shifted = x * kTwoOverPi + kRounder;
  const PackBits quarter = reinterpret_cast<PackBits>(shifted);
  const Pack turns = shifted - kRounder;
  const Pack y = ((x - turns * kHalfPiHigh) - turns * kHalfPiMiddle) - turns * kHalfPiLow;
  const Pack z = y * y;
  Pack s = z * (1.0 / 6227020800.0) - 1.0 / 39916800.0;
  s = s * z + 1.0 / 362880.0;
  s = s * z - 1.0 / 5040.0;
  s = s * z + 1.0 / 120.0;
  s = s * z - 1.0 / 6.0;
  s = y + y * z * s;
  Pack c = z * (-1.0 / 87178291200.0) + 1.0 / 479001600.0;
  c = c * z - 1.0 / 3628800.0;
  c = c * z + 1.0 / 40320.0;
  c = c * z - 1.0 / 720.0;
  c = c * z + 1.0 / 24.0;
  c = 1.0 - 0.5 * z + z * z * c;
  const PackBits odd = (quarter & 1) != 0;
  const Pack sine_raw = odd ? c : s;
  const Pack cosine_raw = odd ? s : c;
  sine = (quarter & 2) != 0 ? -sine_raw : sine_raw;
  cosine = ((quarter + 1) & 2) != 0 ? -cosine_raw : cosine_raw;
}

}  // namespace otter_nav::tracker
