// continuations.hpp: every motion that continues a given one, by trying all combinations of what rigid
// contacts may do. Nothing of src/decide is used, and numbers have 64 bits.
//
//   r = b + W f,   r = (rn_1, rt_1, rn_2, ...),   f = (l_1, k_1, l_2, ...)
//
//   open     l = k = 0,       rn >= 0
//   stick    rn = rt = 0,     l >= 0,  |k| <= mu l
//   slip s   rn = 0,          l >= 0,  k = -s mu l,  s rt >= 0 unless the contact slides along s already
//
// r are accelerations and f forces, or velocities after and impulses.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace signorini::differential {

using Extended = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
using ExtendedMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

struct Question {
  ExtendedMatrix W;              ///< 2m x 2m
  Extended b;                    ///< 2m
  Extended size;                 ///< 2m: sum of the magnitudes of the terms of b, >= 0
  std::vector<double> friction;  ///< m
  std::vector<int> sliding;      ///< m: +1 or -1 where it slides along the tangent already, else 0
};

struct Continuations {
  std::vector<Extended> responses;  ///< those that differ by more than 1e-8 of the problem's size
  std::vector<Extended> forces;     ///< one for each of them
  bool sharp = true;                ///< no other combination fails by less than 1e-8
  double condition = 1.0;  ///< of W, frictionless tangents apart, in units that make its diagonal one
};

[[nodiscard]] Continuations continuations(const Question& question);

}  // namespace signorini::differential
