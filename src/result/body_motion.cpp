#include "result/body_motion.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>

#include "result/csv.hpp"
#include "scene/mesh_lines.hpp"

namespace signorini {

BodyMotionFile::BodyMotionFile(const Scene& scene, const Model& model)
    : scene_(scene), nodes_(drawn_mesh_nodes(scene)), movers_(scene, model) {
  if (nodes_.empty()) return;
  const std::size_t times = scene.run.grid().size();
  const std::size_t wanted = std::clamp(most_values / (2 * nodes_.size()), fewest_times, most_times);
  every_ = std::max<std::size_t>(1, (times + wanted - 2) / wanted);
}

std::vector<double> BodyMotionFile::row(const Sample& sample) const {
  std::vector<double> values{sample.t};
  for (const int node : nodes_)
    for (const std::size_t axis : {0U, 1U})
      values.push_back(movers_.value(static_cast<std::size_t>(node), axis, sample));
  return values;
}

void BodyMotionFile::add(const Sample& sample) {
  if (nodes_.empty()) return;
  if (count_++ % every_ == 0) {
    rows_.push_back(row(sample));
    last_.clear();
  } else {
    last_ = row(sample);
  }
}

void BodyMotionFile::write(const std::filesystem::path& directory) const {
  if (rows_.empty()) return;
  CsvFile file(directory / "body_motion.csv");
  CsvBlock block;
  block.text("t");
  for (const int node : nodes_)
    for (const char* axis : {".ux", ".uy"})
      block.text(scene_.nodes[static_cast<std::size_t>(node)].name + axis);
  block.end_row();
  const auto put = [&](const std::vector<double>& values) {
    block.number(values[0]);
    for (std::size_t i = 1; i < values.size(); ++i)
      block.number(std::strtod(fmt::format("{:.6g}", values[i]).c_str(), nullptr));
    block.end_row();
    file.write(block);
  };
  for (const std::vector<double>& values : rows_) put(values);
  if (!last_.empty()) put(last_);
}

}  // namespace signorini
