// body_frames.hpp: stresses of bodies and tractions of seams at chosen times, and motions of meshes
// (docs/output.md).
//
//   frame_bodies.csv  t,body,node,x,y,ux,uy,xx,yy,xy,mises                          all nodes of all bodies
//   frame_seams.csv   t,seam,contact,node,s,x,y,pressure,shear,opening,slip,state   along the arc of each seam
//
//   sigma = D (B (u + beta v) - alpha T e) at the nodes (model/element/nodal_stress.hpp)
//   pressure = -N_k / (D_k t),   shear = T_k / (D_k t),   s_k = s_(k-1) + |x_k - x_(k-1)|
//
// Positions are undeformed. Stresses are positive in tension, pressures in compression; unit: force/length^2.
// D_k t: the tributary area of a seam's node. opening: the gap. The files are created with the first frame.
// Errors: FileError.
#pragma once

#include <Eigen/SparseCore>
#include <filesystem>
#include <optional>
#include <vector>

#include "result/frames.hpp"
#include "result/table.hpp"
#include "signorini/result.hpp"
#include "signorini/scene.hpp"

namespace signorini::result {

struct BodyFrameRow {
  double t = 0.0;
  const std::string& body;
  const Node& node;
  std::array<double, 2> u{0.0, 0.0};
  Eigen::Vector3d stress;
  double mises = 0.0;
};
/// Columns of frame_bodies.csv.
[[nodiscard]] const CsvTable<BodyFrameRow>& body_frame_table();

struct SeamFrameRow {
  double t = 0.0;
  const std::string& seam;
  const std::string& contact;
  const Node& node;
  double s = 0.0, area = 0.0;
  const ContactSample& sample;
};
/// Columns of frame_seams.csv.
[[nodiscard]] const CsvTable<SeamFrameRow>& seam_frame_table();

/// Rows at time t for the nodes of a seam, in the order of SeamSpec::nodes. contacts: samples of all contacts.
[[nodiscard]] std::vector<SeamFrameRow> seam_frame(const Scene& scene, const SeamSpec& seam, double t,
                                                   const std::vector<ContactSample>& contacts);

class BodyFrameWriter {
 public:
  /// The scene must have bodies. Scene and model must outlive the object.
  BodyFrameWriter(const std::filesystem::path& directory, const Scene& scene, const Model& model);
  void write(const Sample& sample);

 private:
  [[nodiscard]] Vector of_body(const BodySpec& body, const Sample& sample, int order) const;

  const Scene& scene_;
  double beta_;
  NodeDisplacements movers_;
  std::vector<History> strains_;  ///< thermal strain alpha T of each body
  std::vector<Eigen::SparseMatrix<double, Eigen::RowMajor>> stresses_;
  TableFile<BodyFrameRow> bodies_;
  std::optional<TableFile<SeamFrameRow>> seams_;
};

/// Writes body_motion.csv, the motions of the meshes of bodies, for the page (docs/output.md).
///
///   t, NODE.ux, NODE.uy, ...     every k-th output time, the first and the last
///
/// Only drawn nodes are written (scene/outlines.hpp). k is the smallest value for which the table has at most
/// max_values numbers and max_times rows; but at least min_times rows are written, if there are as many output times.
/// Numbers have six digits.
class BodyMotionFile {
 public:
  static constexpr std::size_t max_values = 400'000, min_times = 25, max_times = 250;

  /// Stores nothing for a scene without bodies.
  BodyMotionFile(const Scene& scene, const Model& model);
  /// Must be called at every output time; stores a row at every k-th one.
  void add(const Sample& sample);
  /// Writes no file if nothing was stored. Errors: FileError.
  void write(const std::filesystem::path& directory) const;

 private:
  [[nodiscard]] std::vector<double> row(const Sample& sample) const;

  const Scene& scene_;
  std::vector<int> nodes_;
  NodeDisplacements movers_;
  std::size_t every_ = 1, count_ = 0;
  std::vector<std::vector<double>> rows_;  ///< t, then displacements
  std::vector<double> last_;               ///< row of the latest time; empty if it is in rows_
};

}  // namespace signorini::result
