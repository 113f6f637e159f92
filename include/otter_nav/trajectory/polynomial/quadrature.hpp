// Nodes and weights of Gauss's rules.
#pragma once

#include <array>

namespace otter_nav::trajectory {

template <std::size_t Points>
struct Quadrature {
  std::array<double, Points> at;
  std::array<double, Points> weight;
};

// Gauss and Legendre's on [-1, 1]: exact to degree 9.
constexpr Quadrature<5> kGauss = {
    {-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831, 0.9061798459386640},
    {0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
     0.2369268850561891}};

// Gauss and Lobatto's on [0, 1], with both ends: exact to degree 13.
constexpr int kLobattoPoints = 8;
constexpr Quadrature<kLobattoPoints> kLobatto = {
    {0.0, 0.5 - 0.5 * 0.8717401485096066, 0.5 - 0.5 * 0.5917001814331423,
     0.5 - 0.5 * 0.2092992179024789, 0.5 + 0.5 * 0.2092992179024789, 0.5 + 0.5 * 0.5917001814331423,
     0.5 + 0.5 * 0.8717401485096066, 1.0},
    {0.5 / 28.0, 0.5 * 0.2107042271435061, 0.5 * 0.3411226924835044, 0.5 * 0.4124587946587038,
     0.5 * 0.4124587946587038, 0.5 * 0.3411226924835044, 0.5 * 0.2107042271435061, 0.5 / 28.0}};

}  // namespace otter_nav::trajectory
