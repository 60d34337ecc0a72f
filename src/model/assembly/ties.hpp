// ties.hpp: tied motions: nodes of a rigid body follow its centre (small rotations), nodes of a tied seam follow the nodes of
// its master.
//
//   ux_P = ux_C - rz (y_P - y_C),   uy_P = uy_C + rz (x_P - x_C),   rz_P = rz_C          u = T q
//
// q contains the degrees of freedom of the centre C, but none of the nodes P: M = T^T M_full T, and
// likewise K, C, loads and the forms of contacts. A support at any node of a body removes a degree of freedom
// from q. With A supported in x and B in y,
//
//   ux_P = -rz (y_P - y_A),   uy_P = rz (x_P - x_B),
//
// Two nodes supported in x at different heights, or in y at different x, also fix rz. A moving support
// contributes its motion, s - rz (y_P - y_A). All motions of a body that are not degrees of freedom are tied,
// including those of the centre.
#pragma once

#include <optional>
#include <vector>

#include "model/assembly/dofs.hpp"

namespace signorini::assembly {

/// A component of a body's motion that a support fixes, with the coordinate perpendicular to the component.
struct BodyConstraint {
  double coordinate = 0.0;            ///< coordinate of the supported node: y for ux, x for uy
  int moving = DofMap::absent;        ///< index into DofMap::supports; absent: the support has no motion
  std::size_t support = 0, node = 0;  ///< index into Scene::supports, mesh node
};

/// Free and fixed components of a body's motion.
struct BodyMotion {
  int centre = 0;                                            ///< mesh node
  std::vector<int> nodes;                                    ///< all nodes, the centre first
  std::array<std::optional<BodyConstraint>, 3> constraints;  ///< ux, uy, rz; nullopt: free
};

/// Sets DofMap::body, and marks the free components of the centres as needed, all other components of bodies as absent.
/// Errors: SceneError for a node that is in two bodies, and for contradictory supports.
[[nodiscard]] std::vector<BodyMotion> find_bodies(const Scene& scene, DofMap& map);

/// Numbers the tied motions, after all degrees of freedom.
void tie(const std::vector<BodyMotion>& bodies, DofMap& map);

/// Supported components of a body's nodes: (node, component) pairs.
[[nodiscard]] std::vector<std::pair<int, std::size_t>> constrained_components(const Scene& scene,
                                                                              const DofMap& map, int body);

/// Elongation of a spring as a form on degrees of freedom and moving supports.
struct Elongation {
  std::vector<int> numbers;
  Vector factors;
};

/// A form that is the sum of motions with given numbers. Coefficients that are zero up to rounding are set to
/// zero.
class TiedForm {
 public:
  explicit TiedForm(const DofMap& map) : map_(map) {}
  /// Adds factor times the motion with this number (DofMap::terms).
  void add(int number, double factor);
  /// True if a moving support contributes; contributions that cancel up to rounding do not.
  [[nodiscard]] bool follows_support() const;
  /// The form on degrees of freedom, without moving supports.
  [[nodiscard]] Combination combination() const;
  [[nodiscard]] Elongation with_supports() const;

 private:
  struct Sum {
    int number;
    double sum, size;
  };
  const DofMap& map_;
  std::vector<Sum> sums_;
};

/// The unknowns of an element with tied nodes: T times degrees of freedom and motions of supports.
struct TiedElement {
  TiedElement(const DofMap& map, const int* numbers, std::size_t count);
  std::vector<int> numbers;  ///< degrees of freedom, or codes of moving supports (DofMap::support_code)
  Eigen::MatrixXd t;         ///< T, size: number of the element's unknowns x numbers.size()

  /// T^T A T for symmetric A, bitwise symmetric; entries that are zero up to rounding become zero.
  [[nodiscard]] Eigen::MatrixXd transform(const Eigen::MatrixXd& a) const;
};

/// True if one of these numbers is tied.
[[nodiscard]] bool any_tied(const DofMap& map, const int* numbers, std::size_t count);

/// Sets Model::ties. The model must have the degrees of freedom of the map.
void add_ties(const Scene& scene, const DofMap& map, Model& model);
/// Recomputes Ties::dofs, after a reduction or after sliding points were added.
void name_tied_dofs(const DofMap& map, Model& model);

// Nodes of tied seams, which follow nodes of their master.
//
//   u_k = sum_l w_kl u_l     along x and y,     w_kl = M_kl / D_k (mesh/mortar.hpp)
//
// Dual mortar method: forces on a slave node k are transferred to master nodes l by T^T f, so a constant
// stress crosses a straight seam exactly. If a master node is tied (rigid body, moving support), the slave
// node follows that motion.

/// Marks the motions of tied nodes as absent, before other motions are numbered. Errors: SceneError for nodes that are
/// moved by supports, rigid bodies or other seams.
void mark_slave_dofs(const Scene& scene, DofMap& map);

/// Numbers the tied motions, after all degrees of freedom and rigid bodies.
void tie_seams(const Scene& scene, DofMap& map);

}  // namespace signorini::assembly
