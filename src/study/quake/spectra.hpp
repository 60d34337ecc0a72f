// spectra.hpp: pseudo-accelerations of oscillators under base motion, and target spectra.
//
//   u'' + 2 z w u' + w^2 u = -a(t),   u(0) = u'(0) = 0,   a linear between its samples
//   PSA(T) = w^2 max |u|,  w = 2 pi / T
//
// Between two samples the motion has a closed form, so there is no time step error. The largest |u| is taken at the
// samples and at intermediate points, 40 per period: PSA is too small by 0.3 % at most.
// Source: N. C. Nigam, P. C. Jennings, Bull. Seism. Soc. Am. 59 (1969) 909.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace signorini::quake {

/// PSA(T) at the damping ratio z, 0 <= z < 1, in the unit of a. a: samples at equal intervals dt > 0; T > 0
/// in the unit of dt. The response includes one period after the last sample, with a = 0.
[[nodiscard]] double pseudo_acceleration(const std::vector<double>& a, double dt, double T, double z);

// Target response spectrum of an accelerogram.
//
//   "ec8-A" ... "ec8-E"   EN 1998-1:2004, 3.2.2.2, elastic, type 1, 5 % damping, ground A to E:
//       0 <= T <= TB   ag S (1 + 1.5 T / TB)          TC <= T <= TD   2.5 ag S TC / T
//       TB <= T <= TC  2.5 ag S                       TD <= T         2.5 ag S TC TD / T^2
//   a file                rows T,PSA with ascending T; log PSA is linear in log T between rows, constant beyond them
//
// Units: T in s; PSA in the unit of ag, or in the unit of the file.

class TargetSpectrum {
 public:
  /// Reads a spectrum. ag: ground acceleration of "ec8-...". Errors: UsageError for an unknown name,
  /// FileError, SceneError for an invalid line.
  static TargetSpectrum read(const std::string& name_or_file, double ag);
  /// PSA(T) for T >= 0.
  [[nodiscard]] double operator()(double T) const;

 private:
  double ag_ = 0.0, soil_ = 0.0, TB_ = 0.0, TC_ = 0.0, TD_ = 0.0;
  std::vector<std::pair<double, double>> rows_;  // (T, PSA) from a file; empty for "ec8-..."
};

}  // namespace signorini::quake
