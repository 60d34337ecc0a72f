// parameter_range.hpp: values of the keys of a sweep: ranges, lists, and draws from distributions.
//
//   0:1.3:0.1     start:stop:step, the stop included if it is a multiple; 0.3 is 0.3, not 0.30000000000000004
//   ida,exact     a list of TOML values; commas inside of quotes, brackets and braces do not separate
//
// Several ranges form a product; the last one varies fastest. Keys of one group vary together and form one
// range at the position of the group's first key.
#pragma once

#include <string>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini::sweep {

/// One `--vary path=values`.
struct ParameterRange {
  std::string path;
  std::string text;                 ///< text of the values, as given
  std::vector<std::string> values;  ///< each in the syntax of `--set`
  int group = 0;                    ///< 0: none; keys of the same group vary together
  bool sampled = false;             ///< the values are draws from the distribution `text`

  friend bool operator==(const ParameterRange&, const ParameterRange&) = default;
};

/// The option that gave the values: "vary" or "sample".
[[nodiscard]] const char* option_of(const ParameterRange& vary);
/// Override that sets the key of `vary` to this value.
[[nodiscard]] Override override_of(const ParameterRange& vary, const std::string& value);
/// Refuses two options that set the same key by different paths (contacts.*.friction and
/// contacts.first.friction), and a setting without effect because all of its keys are varied. Errors:
/// UsageError; errors of the scene file.
void check_overlaps(const std::string& scene, const std::vector<ParameterRange>& varied,
                    const std::vector<Override>& settings);
/// Parses PATH=VALUES of --vary. Errors: UsageError, also for more than 1e6 values.
[[nodiscard]] ParameterRange parse_vary(const std::string& text);
/// The product of all ranges: each entry has one value for each ParameterRange, in their order. Errors: UsageError for more
/// than 1e6 points, for a repeated path, and for keys of one group with different numbers of values.
[[nodiscard]] std::vector<std::vector<Override>> points(const std::vector<ParameterRange>& varied);

// Draws values of keys from distributions.
//
//   normal(0.4, 0.05)        mean, standard deviation
//   lognormal(0.4, 0.05)     mean and standard deviation of the value itself, which is positive:
//                            s^2 = log(1 + (sd/mean)^2), m = log(mean) - s^2/2
//   uniform(0.3, 0.5)        from, to
//   triangular(0.3, 0.35, 0.5)   minimum, mode, maximum
//
//   x_ij = F_j^-1(u_ij)      row i, draw j, which one or several keys share
//   random   u from the Mersenne twister of the seed, draw by draw, row by row
//   sobol    point i of Sobol's sequence, shifted by one vector of random draws, modulo 1
//
// The values of row i depend only on the seed, i and the number of draws per row. Therefore more samples do not change earlier
// samples; parts of a sweep, resumed sweeps and other machines draw the same values. Source of both sequences: GSL.

enum class Sequence { random, sobol };

struct SampleSpec {
  std::size_t count = 1000;
  unsigned long seed = 1;
  Sequence sequence = Sequence::random;
};

/// Keys from texts PATH,PATH,...=DISTRIBUTION, with `count` values each, all in one group; keys of one text have the
/// same values. Errors: UsageError.
[[nodiscard]] std::vector<ParameterRange> draw_samples(const std::vector<std::string>& texts,
                                                       const SampleSpec& spec);

}  // namespace signorini::sweep
