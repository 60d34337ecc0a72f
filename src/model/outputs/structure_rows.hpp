// structure_rows.hpp: internal forces of the structure as functionals of its motion.
//
//   ends of an element     f = k (u + beta v) + k_g u + m (a + alpha v + r a_b - r g) - f_q q(t) - f_s strain(t)
//   reaction of a support  R = sum of f + springs + masses + ( N n + T t ) of contacts - forces at the node
//   sum over the supports  R = inertia - loads + springs and contacts to the ground
//
// a_b: acceleration of the base, g: gravity. For scenes with nodes. Degrees of freedom moved by a support
// follow the support's history, fixed degrees of freedom are zero.
#pragma once

#include "model/assembly/loads.hpp"
#include "model/assembly/member_pieces.hpp"
#include "signorini/model.hpp"

namespace signorini::outputs {

/// An output in terms of the physical degrees of freedom.
struct PhysicalRow {
  explicit PhysicalRow(int n) : u(Vector::Zero(n)), v(u), a(u), rayleigh(u) {}
  Vector u, v, a;
  Vector rayleigh;  ///< part of v that is due to the damping alpha M + beta K
  std::vector<Output::ContactForces> forces;
  std::vector<Output::Given> given;
  double constant = 0.0;
  /// A contact whose curved surface adds N u / R with varying N, and the factor of that force.
  struct CurvedContact {
    std::size_t contact = 0;
    double factor = 0.0;
  };
  std::vector<CurvedContact> curved_contacts = {};
};

class StructureRows {
 public:
  /// alpha, beta: the Rayleigh factors in use. All arguments must outlive the object.
  StructureRows(const Scene& scene, const assembly::DofMap& map, double alpha, double beta);

  /// row += cu u + (cv + rayleigh) v + ca a for the motion `number` (DofMap::numbers_at()).
  void add_motion(PhysicalRow& row, int number, double cu, double cv, double ca, double rayleigh = 0.0) const;
  /// Adds x a_x + y a_y, where a is the acceleration of the base minus gravity; gravity = false: without gravity.
  void add_base_acceleration(PhysicalRow& row, double x, double y, bool gravity = true) const;
  /// Adds a section force of an element. cut: its factors (element/element.hpp).
  void add_section_force(PhysicalRow& row, std::size_t element, const element::SectionForce& cut) const;
  /// Adds factors . (sigma_x, sigma_y, tau_xy) at a mesh node of body `body` of Scene::bodies (nodal_stress.hpp),
  /// including stiffness-proportional damping: sigma = D (B (u + beta v) - alpha T e).
  void add_stress(PhysicalRow& row, std::size_t body, int node, const Eigen::RowVector3d& factors) const;
  /// Adds the force in a spring times a factor, preload and damper included. The force is positive if the node has
  /// moved along the spring's direction. rotation: takes the rotational stiffness and damping.
  void add_spring(PhysicalRow& row, const Spring& spring, bool rotation, double factor) const;
  /// Adds the reaction at component c (0 x, 1 y, 2 rotation) of a node, times a factor.
  void add_reaction(PhysicalRow& row, int node, std::size_t c, double factor) const;
  /// Adds loads minus inertia, minus the forces of springs and contacts to the ground, along x (c = 0) or y
  /// (c = 1).
  void add_total(PhysicalRow& row, std::size_t c) const;

 private:
  [[nodiscard]] const element::FiniteElement& element(std::size_t i) const { return map_.mesh.element(i); }
  /// Adds the end forces of an element times the factors of `cut`. stiff: with stiffness and strain terms.
  void add_end_forces(PhysicalRow& row, std::size_t element, const element::SectionForce& cut,
                      bool stiff) const;
  void add_mass(PhysicalRow& row, const PointMass& mass, std::size_t c, double factor) const;
  void add_moved_mass(PhysicalRow& row, std::size_t element, int node, std::size_t c, double factor) const;
  void add_load(PhysicalRow& row, std::size_t load, double factor) const;
  void add_force(PhysicalRow& row, std::size_t load, int node, std::size_t c, double factor) const;
  void add_contact(PhysicalRow& row, std::size_t contact, int node, std::size_t c, double factor) const;
  [[nodiscard]] std::array<double, 3> direction_of(const Spring& spring) const;

  const Scene& scene_;
  const assembly::DofMap& map_;
  double alpha_, beta_;
  std::vector<History> moving_, base_;  // histories of moving supports; accelerations of the base
  struct Uniform {
    std::size_t load;
    std::array<double, 2> q;  // along x and y, for a unit amplitude
  };
  std::vector<std::vector<Uniform>> uniform_;                // per element
  std::vector<std::vector<assembly::NodeForce>> tractions_;  // per load
  std::vector<Output::Given> loads_;           // histories of Scene::loads, times the amplitudes
  std::vector<std::vector<History>> strains_;  // per member; then per body
};

// N, V, M and stresses along a piece of a member.
//
//   stress = N / area -+ i M / modulus      - on the left of the path, + on its right, where M > 0 is tensile
//
// i: stress intensification factor of the output if given, otherwise of the pipe bend.

/// A path between the two nodes of a piece. backwards: true if the path runs from the end to the start of the piece.
struct MemberPath {
  const element::MeshPiece* piece = nullptr;
  bool backwards = false;
};

struct SectionQuantity {
  OutputQuantity quantity = OutputQuantity::N;  ///< stress, or N, V, M
  Fibre fibre = Fibre::both;                    ///< fibre of a stress: left or right
  double N_factor = 1.0, M_factor = 1.0;        ///< factors of the parts of a stress from N and from M
  std::optional<double> intensification = {};
};

/// Returns the section quantity that an output requests, for one fibre.
[[nodiscard]] SectionQuantity section_quantity(const OutputSpec& spec, Fibre fibre);

/// Number of points in an element at which a polynomial interpolates the quantity exactly (base/curves.hpp).
[[nodiscard]] std::size_t points_of(OutputQuantity quantity);

class MemberForces {
 public:
  MemberForces(const Scene& scene, const assembly::DofMap& map) : scene_(scene), map_(map) {}

  /// Index of the k-th element on the path.
  [[nodiscard]] static std::size_t element_of(const MemberPath& way, std::size_t k);
  /// The quantity at a position x, 0 to 1, of the k-th element on the path. Errors: SceneError under `key`
  /// for a section without area or modulus.
  [[nodiscard]] element::SectionForce section_force(const MemberPath& way, std::size_t k, double x,
                                                    const SectionQuantity& wanted, const SourcePlace& place,
                                                    const std::string& key) const;
  /// Number k of the element on the path, and position x in it, for a station 0 to 1 along the whole piece.
  [[nodiscard]] static std::pair<std::size_t, double> place_of(const MemberPath& way, double station);

 private:
  [[nodiscard]] element::SectionForce force(const MemberPath& way, std::size_t k, double x,
                                            OutputQuantity quantity) const;

  const Scene& scene_;
  const assembly::DofMap& map_;
};

}  // namespace signorini::outputs
