#include "result/body_frames.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "model/element/nodal_stress.hpp"
#include "result/csv.hpp"
#include "scene/history_from_spec.hpp"
#include "scene/outlines.hpp"

namespace signorini::result {

const CsvTable<BodyFrameRow>& body_frame_table() {
  using R = BodyFrameRow;
  static const CsvTable<R> table = {
      {"t", &R::t},
      {"body", [](const R& r) { return std::string_view(r.body); }},
      {"node", [](const R& r) { return std::string_view(r.node.name); }},
      {"x", [](const R& r) { return r.node.x; }},
      {"y", [](const R& r) { return r.node.y; }},
      {"ux", [](const R& r) { return r.u[0]; }},
      {"uy", [](const R& r) { return r.u[1]; }},
      {"xx", [](const R& r) { return r.stress[0]; }},
      {"yy", [](const R& r) { return r.stress[1]; }},
      {"xy", [](const R& r) { return r.stress[2]; }},
      {"mises", &R::mises},
  };
  return table;
}

const CsvTable<SeamFrameRow>& seam_frame_table() {
  using R = SeamFrameRow;
  static const CsvTable<R> table = {
      {"t", &R::t},
      {"seam", [](const R& r) { return std::string_view(r.seam); }},
      {"contact", [](const R& r) { return std::string_view(r.contact); }},
      {"node", [](const R& r) { return std::string_view(r.node.name); }},
      {"s", &R::s},
      {"x", [](const R& r) { return r.node.x; }},
      {"y", [](const R& r) { return r.node.y; }},
      {"pressure", [](const R& r) { return is_open(r.sample.state) ? 0.0 : -r.sample.N / r.area; }},
      {"shear", [](const R& r) { return r.sample.T / r.area; }},
      {"opening", [](const R& r) { return r.sample.gap; }},
      {"slip", [](const R& r) { return r.sample.slip; }},
      {"state", [](const R& r) { return signorini::to_string(r.sample.state); }},
  };
  return table;
}

std::vector<SeamFrameRow> seam_frame(const Scene& scene, const SeamSpec& seam, double t,
                                     const std::vector<ContactSample>& contacts) {
  std::vector<SeamFrameRow> rows;
  double s = 0.0;
  const Node* before = nullptr;
  for (std::size_t i = 0; i < seam.nodes.size(); ++i) {
    const SeamNode& k = seam.nodes[i];
    const Node& node = scene.nodes[static_cast<std::size_t>(k.node)];
    if (before) s += std::hypot(node.x - before->x, node.y - before->y);
    before = &node;
    const std::size_t contact = seam.first_contact + i;
    rows.push_back(
        {t, seam.name, scene.contacts[contact].name, node, s, k.length * seam.thickness, contacts[contact]});
  }
  return rows;
}

BodyFrameWriter::BodyFrameWriter(const std::filesystem::path& directory, const Scene& scene,
                                 const Model& model)
    : scene_(scene),
      beta_(model.beta),
      movers_(scene, model),
      bodies_(directory / "frame_bodies.csv", body_frame_table()) {
  if (!scene.seams.empty()) seams_.emplace(directory / "frame_seams.csv", seam_frame_table());
  const element::Mesh mesh = element::make_mesh(scene);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const BodySpec& body = scene.bodies[i];
    stresses_.push_back(element::nodal_stresses(mesh, scene, i));
    strains_.push_back(scene::make_history(body.temperature, fmt::format("bodies.{}.temperature", body.name))
                           .scaled(body.thermal_expansion));
  }
}

/// Displacements (order 0) or velocities (order 1) of the nodes of a body: x and y of the first node, of the second, ...
Vector BodyFrameWriter::of_body(const BodySpec& body, const Sample& sample, int order) const {
  Vector own(static_cast<Eigen::Index>(2 * body.node_count));
  for (std::size_t k = 0; k < body.node_count; ++k)
    for (const std::size_t c : {0U, 1U})
      own[static_cast<Eigen::Index>(2 * k + c)] = movers_.value(body.first_node + k, c, sample, order);
  return own;
}

void BodyFrameWriter::write(const Sample& sample) {
  for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
    const BodySpec& body = scene_.bodies[i];
    const Vector u = of_body(body, sample, 0);
    Vector strained = u;
    if (beta_ != 0.0) strained += beta_ * of_body(body, sample, 1);
    const Vector stresses = stresses_[i] * strained;
    const double strain = strains_[i].value(sample.t);
    const Eigen::Vector3d heat = strain * element::thermal_stress(body);
    for (std::size_t k = 0; k < body.node_count; ++k) {
      const auto at = static_cast<Eigen::Index>(k);
      const Eigen::Vector3d stress = stresses.segment<3>(3 * at) + heat;
      bodies_.add({sample.t,
                   body.name,
                   scene_.nodes[body.first_node + k],
                   {u[2 * at], u[2 * at + 1]},
                   stress,
                   element::von_mises_stress(body, stress, strain)});
    }
  }
  bodies_.flush();
  for (const SeamSpec& seam : scene_.seams)
    for (const SeamFrameRow& row : seam_frame(scene_, seam, sample.t, sample.contacts)) seams_->add(row);
  if (seams_) seams_->flush();
}

BodyMotionFile::BodyMotionFile(const Scene& scene, const Model& model)
    : scene_(scene), nodes_(scene::drawn_mesh_nodes(scene)), movers_(scene, model) {
  if (nodes_.empty()) return;
  const std::size_t times = scene.run.grid().size();
  const std::size_t wanted = std::clamp(max_values / (2 * nodes_.size()), min_times, max_times);
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

}  // namespace signorini::result
