// quake.hpp: a synthetic accelerogram.
//
//   a(t) = e(t) sum_k A_k cos(w_k t + phi_k) + c1 s (1 - s) + c2 s (1 - s) (1 - 2 s),   s = t / D, w_k = 2 pi k / D
//   phi_k   uniform on [0, 2 pi), from the Mersenne twister of the seed
//   e(t)    increases as (t / 0.15 D)^2, is 1 up to 0.5 D, and decreases as exp(-3 x) to zero at D,
//           x from 0 to 1
//   A_k     by filter, white noise through the ground (Kanai, Tajimi) and a high pass (Clough, Penzien):
//             A_k^2 ~ (1 + 4 zg^2 r^2) / ((1 - r^2)^2 + 4 zg^2 r^2) * q^4 / ((1 - q^2)^2 + 4 zf^2 q^2)
//             r = w/wg, q = w/wf;   then a is scaled so that its largest value is pga
//           by spectrum: as by filter, then A_k *= target(T_k) / PSA(T_k), the best of 20 iterations; not scaled again
//   c1, c2  make the ground's final velocity and displacement zero, starting from rest. a is linear between samples
//
// Sources: R. W. Clough, J. Penzien, Dynamics of Structures (1993), section 28; D. Gasparini, E. Vanmarcke,
// SIMQKE (MIT R76-4, 1976).
#pragma once

#include <functional>
#include <vector>

namespace signorini::quake {

struct QuakeSpec {
  double duration = 20.0;  ///< D, s
  double dt = 0.01;        ///< interval of the samples, s
  double pga = 0.0;        ///< largest |a|, in the unit of a
  unsigned long seed = 1;
  double ground_frequency = 2.5, ground_damping = 0.6;  ///< wg / 2 pi in Hz, zg
  double low_frequency = 0.25, low_damping = 0.6;       ///< wf / 2 pi in Hz, zf
  /// Target PSA at 5 % of critical damping; null: amplitudes by filter.
  std::function<double(double T)> target = {};
};

/// Range of periods over which a spectrum is matched and reported.
inline constexpr double min_matched_period = 0.05, max_matched_period = 2.0;  // s
inline constexpr double spectrum_damping = 0.05;

/// Samples of a at 0, dt, ..., D, in the unit of pga or target.
[[nodiscard]] std::vector<double> quake(const QuakeSpec& spec);

/// Largest |velocity| and |displacement| of the ground, and their final values. The ground starts from rest,
/// and its acceleration a is linear between samples.
struct GroundMotion {
  double velocity = 0.0, displacement = 0.0, end_velocity = 0.0, end_displacement = 0.0;
};
[[nodiscard]] GroundMotion ground_motion(const std::vector<double>& a, double dt);

}  // namespace signorini::quake
