#include "report/mesh_motion.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>

#include "base/eigen_dense.hpp"
#include "result/csv.hpp"
#include "result/frames.hpp"

namespace signorini::report {
namespace {

constexpr int parts = 10;  // segments of a bent line

base::Json row_of(double s, const element::LineShapes& h) {
  return {s, h.a, h.rotation_a, h.b, h.rotation_b};
}

base::Json rows_of(int count, bool hinged_a, bool hinged_b) {
  base::Json rows = base::Json::array();
  for (int i = 0; i <= count; ++i) {
    const double s = static_cast<double>(i) / count;
    rows.push_back(row_of(s, element::hermite_shapes(s, hinged_a, hinged_b)));
  }
  return rows;
}

/// Range from the smallest to the largest coordinate; 1 for a single node.
double extent_of(const base::Json& nodes, const char* coordinate) {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (const base::Json& node : nodes) {
    least = std::min(least, node[coordinate].get<double>());
    greatest = std::max(greatest, node[coordinate].get<double>());
  }
  return nodes.size() < 2 ? 1.0 : greatest - least;
}

}  // namespace

base::Json shapes_json() {
  return {rows_of(1, true, true), rows_of(parts, false, false), rows_of(parts, true, false),
          rows_of(parts, false, true)};
}

int shape_of(const element::MemberLine& line) {
  if (!line.bends || (line.hinged_from && line.hinged_to)) return 0;
  return line.hinged_from ? 2 : line.hinged_to ? 3 : 1;
}

element::LineShapes across_of(const base::Json& row) {
  return {row[1].get<double>(), row[2].get<double>(), row[3].get<double>(), row[4].get<double>()};
}

double fitting_magnification(const base::Json& nodes, const base::Json& curve, double greatest) {
  for (const base::Json& node : nodes)
    for (const std::size_t c : {0U, 1U})
      if (const int column = node["u"][c].get<int>(); column >= 0)
        for (const base::Json& u : curve["columns"][static_cast<std::size_t>(column)]["u"])
          if (u.is_number()) greatest = std::max(greatest, std::abs(u.get<double>()));
  return result::magnification_of(std::max(extent_of(nodes, "x"), extent_of(nodes, "y")), greatest);
}

namespace {

// Allowed error relative to the largest displacement: 0.25 pixels if the page draws this displacement with 250 pixels.
constexpr double accuracy = 1e-3;
constexpr std::size_t max_on_page = 120'000;  // limit of the number of values on the page: about 0.8 MB

base::Json digits(double value, int count) {
  return std::isfinite(value) ? base::Json(std::strtod(fmt::format("{:.{}g}", value, count).c_str(), nullptr))
                              : base::Json(0.0);
}

}  // namespace

void decompose_motion(const Eigen::MatrixXd& displacements, std::size_t most, MeshMotion& motion) {
  motion.greatest = displacements.size() > 0 ? displacements.cwiseAbs().maxCoeff() : 0.0;
  const Eigen::Index n = displacements.rows(), times = displacements.cols();
  motion.shapes.resize(n, 0);
  motion.parts.resize(times, 0);
  if (!(motion.greatest > 0.0)) return;
  const Eigen::MatrixXd scaled = displacements / motion.greatest;
  const base::EigenPairs pairs = base::symmetric_eigen(scaled.transpose() * scaled);
  const auto room = static_cast<Eigen::Index>(most / static_cast<std::size_t>(n + times));
  Eigen::MatrixXd left = scaled;
  for (Eigen::Index k = 1; k <= std::min(std::max<Eigen::Index>(room, 1), times); ++k) {
    const Eigen::VectorXd w = pairs.vectors.col(times - k);
    const Eigen::VectorXd shape = scaled * w;
    const double size = shape.cwiseAbs().maxCoeff();
    if (!(size > 0.0)) break;
    left -= shape * w.transpose();
    motion.shapes.conservativeResize(n, k);
    motion.parts.conservativeResize(times, k);
    motion.shapes.col(k - 1) = shape / size;
    motion.parts.col(k - 1) = w * (size * motion.greatest);
    if (left.cwiseAbs().maxCoeff() <= accuracy) break;
  }
}

MeshMotion mesh_motion(const Scene& scene, const std::filesystem::path& directory) {
  MeshMotion motion;
  const result::TableFolder tables(directory);
  if (!tables.has("body_motion.csv")) return motion;
  result::CsvReader reader = tables.open("body_motion.csv");
  std::map<std::string, std::size_t> header;
  for (std::size_t k = 0; k < reader.header().size(); ++k) header.emplace(reader.header()[k], k);
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i)
    if (const auto at = header.find(scene.nodes[i].name + ".ux"); at != header.end()) {
      motion.nodes.push_back(static_cast<int>(i));
      columns.push_back(at->second);
    }
  std::vector<double> values;
  while (reader.next()) {
    motion.times.push_back(reader.t());
    for (const std::size_t column : columns)
      for (const std::size_t axis : {0U, 1U}) values.push_back(reader.number(column + axis));
  }
  decompose_motion(
      Eigen::Map<const Eigen::MatrixXd>(values.data(), static_cast<Eigen::Index>(2 * columns.size()),
                                        static_cast<Eigen::Index>(motion.times.size())),
      max_on_page, motion);
  return motion;
}

base::Json mesh_motion_json(const MeshMotion& motion) {
  if (motion.nodes.empty()) return nullptr;
  base::Json times = base::Json::array(), shapes = base::Json::array(), parts = base::Json::array();
  for (const double t : motion.times) times.push_back(digits(t, 9));
  for (Eigen::Index k = 0; k < motion.shapes.cols(); ++k) {
    base::Json shape = base::Json::array(), part = base::Json::array();
    for (const double value : motion.shapes.col(k))
      shape.push_back(digits(std::round(value * 1e4) * 1e-4, 5));
    for (const double value : motion.parts.col(k)) part.push_back(digits(value, 6));
    shapes.push_back(std::move(shape));
    parts.push_back(std::move(part));
  }
  return {{"t", std::move(times)},
          {"nodes", motion.nodes},
          {"shapes", std::move(shapes)},
          {"parts", std::move(parts)}};
}

}  // namespace signorini::report
