// body_motion.hpp: body_motion.csv, how the meshes of bodies move, for the page (docs/output.md).
//
//   t, NODE.ux, NODE.uy, ...     every k-th output time, the first and the last; nodes that are drawn (scene/mesh_lines.hpp)
//
// k is the least at which the table has most_values numbers, but at least fewest_times rows where output times are as many.
// Numbers have six digits.
#pragma once

#include <filesystem>
#include <vector>

#include "result/node_movers.hpp"

namespace signorini {

class BodyMotionFile {
 public:
  static constexpr std::size_t most_values = 400'000, fewest_times = 25, most_times = 250;

  /// Nothing is kept of a scene without bodies.
  BodyMotionFile(const Scene& scene, const Model& model);
  /// At every output time.
  void add(const Sample& sample);
  /// Nothing where nothing was kept. Errors: FileError.
  void write(const std::filesystem::path& directory) const;

 private:
  [[nodiscard]] std::vector<double> row(const Sample& sample) const;

  const Scene& scene_;
  std::vector<int> nodes_;
  NodeMovers movers_;
  std::size_t every_ = 1, count_ = 0;
  std::vector<std::vector<double>> rows_;  ///< t, then displacements
  std::vector<double> last_;               ///< not among them yet
};

}  // namespace signorini
