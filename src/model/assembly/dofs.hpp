// dofs.hpp: which degrees of freedom exist, which are fixed, and their numbers.
//
//   node i, component c (0 ux, 1 uy, 2 rz)  ->  number, or `absent`, or `fixed`
//
// A degree of freedom exists only where a member, mass, spring or contact needs it: beams need ux, uy
// and rz of all their nodes, bars and masses ux and uy (rz with an inertia), springs and contacts the
// components of their directions. Supports fix what exists. Numbers follow the order of the nodes; behind
// them stand the rotations of members' hinged ends. A support that moves has a number of its own, of those
// that move. Numbers from size() on are tied: motions of a rigid body's nodes (ties.hpp).
#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "model/element/mesh.hpp"
#include "signorini/model.hpp"

namespace signorini {

/// Part of a tied motion: factor times a degree of freedom, or a support that moves (its code).
struct TiedTerm {
  int number = 0;
  double factor = 1.0;
};

/// A motion that follows from others.
struct TiedDof {
  Dof dof;
  std::vector<TiedTerm> terms;
};

struct DofMap {
  static constexpr int absent = -1, fixed = -2, needed = 0;  // needed: while numbers are given

  Mesh mesh;                               ///< empty in matrix scenes
  std::vector<std::array<int, 3>> number;  ///< a mesh node; empty in matrix scenes
  std::map<std::pair<std::size_t, std::size_t>, int>
      own;                                 ///< an element's own unknowns: element, index into unknowns()
  std::vector<std::array<int, 3>> moving;  ///< a mesh node: which of `supports` it follows, or `absent`
  std::vector<std::size_t> supports;       ///< that move: index into Scene::supports
  std::vector<Dof> dofs;
  std::vector<std::pair<int, int>> where;  ///< a degree of freedom: mesh node, component
  std::vector<int> body;                   ///< a mesh node: index into Scene::rigid, or `absent`
  std::vector<AxialForces> frozen;         ///< an element: what stands in it (geometric.hpp); empty: none
  std::vector<double> body_stiffness;  ///< a rigid body: of its frozen forces (geometric.hpp); empty: none
  std::vector<TiedDof> tied;           ///< numbers size(), size() + 1, ...
  std::vector<Column> columns;
  double shown_length = 1.0;  ///< what one of the lengths here is in the names of motions

  [[nodiscard]] int size() const { return static_cast<int>(dofs.size()); }
  [[nodiscard]] bool matrices() const { return number.empty(); }
  /// What stands for moving support i in numbers_at() and element_numbers().
  [[nodiscard]] static int code_of_moving(int i) { return -3 - i; }
  [[nodiscard]] static int moving_of_code(int code) { return -3 - code; }
  [[nodiscard]] bool is_tied(int n) const { return n >= size(); }
  /// All nodes move with one rigid body, and no unknown is its own: nothing strains the element.
  [[nodiscard]] bool within_body(const FiniteElement& e) const;
  /// All of these mesh nodes move with one rigid body.
  [[nodiscard]] bool in_one_body(const std::vector<int>& nodes) const;
  /// Lets component c of a mesh node follow these.
  void tie(int node, std::size_t c, std::vector<TiedTerm> terms);
  /// What a number stands for: degrees of freedom and codes of moving supports; nothing where fixed or absent.
  [[nodiscard]] std::vector<TiedTerm> terms(int n) const;
  /// form += factor times the motion under a number; what supports move drops out.
  void add(Vector& form, int n, double factor) const;
  /// Of the motion x (size()).
  [[nodiscard]] double value(const Vector& x, int n) const;
  /// Numbers, `fixed`, `absent`, or codes of moving supports.
  [[nodiscard]] std::array<int, 3> numbers_at(int node) const;
  [[nodiscard]] AxialForces frozen_in(std::size_t element) const {
    return frozen.empty() ? AxialForces{} : frozen[element];
  }
  /// Of its unknowns, in the same way.
  [[nodiscard]] std::vector<int> element_numbers(std::size_t element) const;
};

/// Components of v along x and y; those below roundoff of the length of v are zero.
[[nodiscard]] std::array<double, 2> clean_direction(const std::array<double, 2>& v);

/// The tangent of a normal: n = (nx, ny) has t = (ny, -nx); both unit vectors.
[[nodiscard]] std::array<double, 2> tangent_of(const std::array<double, 2>& normal);

/// The vector along which a contact of a node scene slides; zero when it has neither tangent nor normal.
[[nodiscard]] std::array<double, 2> sliding_direction(const ContactSpec& contact);

[[nodiscard]] DofMap number_nodes(const Scene& scene);
/// mesh: of the scene, or with elements that no type of member has.
[[nodiscard]] DofMap number_nodes(const Scene& scene, Mesh mesh);
/// The error of a moment or a turn at a node whose rotation is absent.
[[noreturn]] void refuse_turn(const SourcePlace& place, const std::string& key, const std::string& node);
[[nodiscard]] DofMap number_matrices(const MatricesSpec& matrices);

/// A direction as a form on the numbered degrees of freedom, less what it is against. Fixed ones drop out;
/// one that does not exist is an error that names it, unless `skip_absent`. `unit`: normalise the plane
/// vector.
[[nodiscard]] Combination combination(const DofMap& map, const Direction& direction, const std::string& key,
                                      bool unit, bool skip_absent = false);

}  // namespace signorini
