// sample.hpp: values of keys drawn from distributions.
//
//   normal(0.4, 0.05)        mean, standard deviation
//   lognormal(0.4, 0.05)     the same of the value itself, which is positive:
//                            s^2 = log(1 + (sd/mean)^2), m = log(mean) - s^2/2
//   uniform(0.3, 0.5)        from, to
//   triangular(0.3, 0.35, 0.5)   least, most likely, greatest
//
//   x_ij = F_j^-1(u_ij)      row i, draw j, which one key or several have
//   random   u from the Mersenne twister of the seed, draw by draw, row by row
//   sobol    point i of Sobol's sequence, shifted by one vector of such draws, modulo 1
//
// Row i depends on the seed, i and the number of draws a row alone: more samples leave the earlier ones as they are,
// and shares, resumed sweeps and other machines draw the same. Source of both sequences: GSL.
#pragma once

#include "study/sweep/vary.hpp"

namespace signorini {

enum class Sequence { random, sobol };

struct SampleSpec {
  std::size_t count = 1000;
  unsigned long seed = 1;
  Sequence sequence = Sequence::random;
};

/// One a key of texts PATH,PATH,...=DISTRIBUTION, with `count` values each, all in one group; keys of one text have the
/// same values. Errors: UsageError.
[[nodiscard]] std::vector<Vary> draw_samples(const std::vector<std::string>& texts, const SampleSpec& spec);

}  // namespace signorini
