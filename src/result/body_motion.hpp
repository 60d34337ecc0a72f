// body_motion.hpp: body_motion.csv, motions of the meshes of bodies, for the page (docs/output.md).
//
//   t, NODE.ux, NODE.uy, ...     every k-th output time, the first and the last; drawn nodes only
// (scene/mesh_lines.hpp)
//
// k is the smallest value for which the table has at most most_values numbers, but it has at least fewest_times rows if
// there are as many output times. Numbers have six digits.
#pragma once

#include <filesystem>
#include <vector>

#include "result/node_movers.hpp"

namespace signorini {

class BodyMotionFile {
 public:
  static constexpr std::size_t most_values = 400'000, fewest_times = 25, most_times = 250;

  /// Stores nothing for a scene without bodies.
  BodyMotionFile(const Scene& scene, const Model& model);
  /// To be called at every output time.
  void add(const Sample& sample);
  /// Writes no file if nothing was stored. Errors: FileError.
  void write(const std::filesystem::path& directory) const;

 private:
  [[nodiscard]] std::vector<double> row(const Sample& sample) const;

  const Scene& scene_;
  std::vector<int> nodes_;
  NodeMovers movers_;
  std::size_t every_ = 1, count_ = 0;
  std::vector<std::vector<double>> rows_;  ///< t, then displacements
  std::vector<double> last_;               ///< the last row, not yet in rows_
};

}  // namespace signorini
