// response_spectrum.hpp: pseudo-accelerations of oscillators on a shaken base.
//
//   u'' + 2 z w u' + w^2 u = -a(t),   u(0) = u'(0) = 0,   a linear between its samples
//   PSA(T) = w^2 max |u|,  w = 2 pi / T
//
// Between two samples the motion is known in closed form, and goes from one to the next without error of a step. The
// greatest |u| is that at the samples and at as many points between them as give 40 a period: PSA is too small by 0.3 % at most.
// Source: N. C. Nigam, P. C. Jennings, Bull. Seism. Soc. Am. 59 (1969) 909.
#pragma once

#include <vector>

namespace signorini {

/// `a`: samples at equal distances dt > 0. Unit: that of a; T > 0 and dt in one unit of time; 0 <= z < 1. The oscillator is followed for
/// a period after the last sample, in which a = 0.
[[nodiscard]] double pseudo_acceleration(const std::vector<double>& a, double dt, double T, double z);

}  // namespace signorini
