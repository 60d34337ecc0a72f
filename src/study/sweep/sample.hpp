// sample.hpp: draws values of keys from distributions.
//
//   normal(0.4, 0.05)        mean, standard deviation
//   lognormal(0.4, 0.05)     mean and standard deviation of the value itself, which is positive:
//                            s^2 = log(1 + (sd/mean)^2), m = log(mean) - s^2/2
//   uniform(0.3, 0.5)        from, to
//   triangular(0.3, 0.35, 0.5)   minimum, mode, maximum
//
//   x_ij = F_j^-1(u_ij)      row i, draw j, which one or several keys share
//   random   u from the Mersenne twister of the seed, draw by draw, row by row
//   sobol    point i of Sobol's sequence, shifted by one vector of such draws, modulo 1
//
// Row i depends only on the seed, i and the number of draws per row: more samples leave the earlier ones unchanged, and
// shares, resumed sweeps and other machines draw the same values. Source of both sequences: GSL.
#pragma once

#include "study/sweep/vary.hpp"

namespace signorini {

enum class Sequence { random, sobol };

struct SampleSpec {
  std::size_t count = 1000;
  unsigned long seed = 1;
  Sequence sequence = Sequence::random;
};

/// Keys from texts PATH,PATH,...=DISTRIBUTION, with `count` values each, all in one group; keys of one text have the
/// same values. Errors: UsageError.
[[nodiscard]] std::vector<Vary> draw_samples(const std::vector<std::string>& texts, const SampleSpec& spec);

}  // namespace signorini
