// dofs.hpp: numbers of the degrees of freedom, and which of them exist or are fixed.
//
//   node i, component c (0 ux, 1 uy, 2 rz)  ->  number, or `absent`, or `fixed`
//
// A degree of freedom exists only if a member, mass, spring or contact needs it. Beams need ux, uy and rz of
// all their nodes, bars and masses ux and uy (rz with an inertia), springs and contacts the components of
// their directions. Supports fix existing degrees of freedom. Numbers follow the order of the nodes; the
// rotations of members' hinged ends come last. Moving supports are numbered separately. Numbers from size() on
// are tied: motions of a rigid body's nodes and of seams (ties.hpp).
#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "model/element/mesh.hpp"
#include "signorini/model.hpp"

namespace signorini::assembly {

/// Term of a tied motion: factor times a degree of freedom, or times a moving support (DofMap::support_code).
struct TiedTerm {
  int number = 0;
  double factor = 1.0;
};

/// A motion that is a combination of degrees of freedom and support motions: the sum of its terms.
struct TiedDof {
  Dof dof;
  std::vector<TiedTerm> terms;
};

struct DofMap {
  static constexpr int absent = -1, fixed = -2, needed = 0;  // needed: exists, but has no number yet

  element::Mesh mesh;                      ///< empty in matrix scenes
  std::vector<std::array<int, 3>> number;  ///< one per mesh node; empty in matrix scenes
  /// Number of each internal unknown of an element; key: element, index into its unknowns().
  std::map<std::pair<std::size_t, std::size_t>, int> internal;
  /// Per mesh node and component: index into `supports` of the support that moves the component, or `absent`.
  std::vector<std::array<int, 3>> moving;
  std::vector<std::size_t> supports;  ///< moving supports: indices into Scene::supports
  std::vector<Dof> dofs;
  std::vector<std::pair<int, int>> locations;  ///< per degree of freedom: mesh node, component
  std::vector<int> body;                       ///< per mesh node: index into Scene::rigid, or `absent`
  /// Per element: its axial prestress (prestress.hpp); empty without prestress.
  std::vector<element::AxialForces> axial_forces;
  /// Per rigid body: geometric stiffness of its prestress (prestress.hpp); empty without prestress.
  std::vector<double> body_stiffness;
  std::vector<TiedDof> tied;  ///< tied motions, whose numbers are size(), size() + 1, ...
  std::vector<signorini::Column> columns;
  double message_length_factor = 1.0;  ///< factor from internal lengths to lengths in messages

  [[nodiscard]] int size() const { return static_cast<int>(dofs.size()); }
  [[nodiscard]] bool is_matrix_scene() const { return number.empty(); }
  /// Code of moving support i in numbers_at() and element_numbers().
  [[nodiscard]] static int support_code(int i) { return -3 - i; }
  [[nodiscard]] static int support_of_code(int code) { return -3 - code; }
  [[nodiscard]] bool is_tied(int n) const { return n >= size(); }
  /// True if all nodes move with one rigid body and the element has no internal unknowns, so that it has no strain.
  [[nodiscard]] bool within_body(const element::FiniteElement& e) const;
  /// True if all mesh nodes of the list move with one rigid body.
  [[nodiscard]] bool in_one_body(const std::vector<int>& nodes) const;
  /// Ties component c of a mesh node: the component becomes the sum of `terms`.
  void tie(int node, std::size_t c, std::vector<TiedTerm> terms);
  /// The motion with this number as a combination of degrees of freedom and moving supports; empty if fixed
  /// or absent.
  [[nodiscard]] std::vector<TiedTerm> terms(int n) const;
  /// form += factor times the motion with number n; terms of moving supports are dropped.
  void add(Vector& form, int n, double factor) const;
  /// Value of the motion with number n if the degrees of freedom have the values x, of length size(), and moving supports are
  /// at zero.
  [[nodiscard]] double value(const Vector& x, int n) const;
  /// For each component of a node: its number, `fixed`, `absent`, or the code of a moving support.
  [[nodiscard]] std::array<int, 3> numbers_at(int node) const;
  [[nodiscard]] element::AxialForces axial_forces_in(std::size_t element) const {
    return axial_forces.empty() ? element::AxialForces{} : axial_forces[element];
  }
  /// The degree of freedom of a component of a node: its number, or, of a node with a motion relative to an obstacle
  /// (moving_obstacles.hpp), the number of this relative motion. Otherwise `fixed` or `absent`, also for other tied motions.
  [[nodiscard]] int own_number(int node, std::size_t c) const;
  /// Numbers of the element's unknowns, coded as in numbers_at().
  [[nodiscard]] std::vector<int> element_numbers(std::size_t element) const;
};

/// Components of v along x and y; a component below the roundoff of |v| is set to zero.
[[nodiscard]] std::array<double, 2> clean_direction(const std::array<double, 2>& v);

/// The tangent of a normal: n = (nx, ny) has t = (ny, -nx); both unit vectors.
[[nodiscard]] std::array<double, 2> tangent_of(const std::array<double, 2>& normal);

/// The direction along which a contact of a scene with nodes slides; zero if the contact has neither tangent nor
/// normal.
[[nodiscard]] std::array<double, 2> sliding_direction(const ContactSpec& contact);

/// Numbers the degrees of freedom of a scene with nodes.
[[nodiscard]] DofMap number_nodes(const Scene& scene);
/// Same as number_nodes(scene), with a given mesh: that of the scene, or a mesh with additional element types.
[[nodiscard]] DofMap number_nodes(const Scene& scene, element::Mesh mesh);
/// Throws the SceneError for a moment or a prescribed rotation at a node without rotation.
[[noreturn]] void refuse_missing_rotation(const SourcePlace& place, const std::string& key,
                                          const std::string& node);
/// Numbers the degrees of freedom of matrices from files.
[[nodiscard]] DofMap number_matrices(const MatricesSpec& matrices);

/// A direction as a form on the degrees of freedom, minus the form of its counterpart (`against`). Fixed components are
/// dropped. An absent component is an error at `key`, unless `skip_absent`. unit: the plane vector is
/// normalised.
[[nodiscard]] Combination combination(const DofMap& map, const Direction& direction, const std::string& key,
                                      bool unit, bool skip_absent = false);

// Place in the scene file from which a degree of freedom comes.
//
//   a named node       its line in [nodes]
//   an inner node      its member, also for the rotation of a hinged end
//   matrices           the stiffness

[[nodiscard]] SourcePlace place_of_dof(const Scene& scene, const DofMap& map, int dof);
/// Place of the structure as a whole: its first member or node, or its mass matrix.
[[nodiscard]] SourcePlace place_of_structure(const Scene& scene);

}  // namespace signorini::assembly
