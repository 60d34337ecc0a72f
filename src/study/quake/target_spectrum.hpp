// target_spectrum.hpp: target response spectrum of an accelerogram.
//
//   "ec8-A" ... "ec8-E"   EN 1998-1:2004, 3.2.2.2, elastic, type 1, 5 % damping, ground A to E:
//       0 <= T <= TB   ag S (1 + 1.5 T / TB)          TC <= T <= TD   2.5 ag S TC / T
//       TB <= T <= TC  2.5 ag S                       TD <= T         2.5 ag S TC TD / T^2
//   a file                rows T,PSA with ascending T; log PSA is linear in log T between rows, constant beyond them
//
// Unit of T: s; of PSA: that of ag, or the file's.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace signorini {

class TargetSpectrum {
 public:
  /// Errors: UsageError for an unknown name, FileError, SceneError for an invalid line.
  static TargetSpectrum read(const std::string& name_or_file, double ag);
  /// T >= 0.
  [[nodiscard]] double operator()(double T) const;

 private:
  double ag_ = 0.0, soil_ = 0.0, TB_ = 0.0, TC_ = 0.0, TD_ = 0.0;
  std::vector<std::pair<double, double>> rows_;  // rows of a file
};

}  // namespace signorini
