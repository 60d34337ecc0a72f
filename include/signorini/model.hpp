// model.hpp: a scene as system matrices, loads and contacts.
//
//   M u'' + C u' + K u = P(t) - sum_k ( n_k N_k + t_k T_k ),   P(t) = sum_i d_i f_i(t)
//
// K contains no contact springs. Only degrees of freedom that exist and are not fixed are numbered; those with a zero row of
// M are massless. All vectors have length n, the number of degrees of freedom. In a reduced model (`reduction` is set) the
// degrees of freedom are amplitudes of modes and of static shapes; contacts and loads are forms on these amplitudes, while
// columns and drawing refer to the physical degrees of freedom. For a rigid body only its centre is numbered; the nodes tied
// to the centre follow (`ties`).
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <optional>
#include <string>
#include <vector>

#include "signorini/contact.hpp"
#include "signorini/force_layout.hpp"
#include "signorini/output.hpp"
#include "signorini/scene.hpp"

namespace signorini {

using Vector = Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;  // column-major, both triangles stored

struct Dof {
  std::string displacement;  ///< "A.ux", "A.rz", "d0.u"; inner nodes of elements: "B-D.3.ux"
  std::string velocity;      ///< "A.vx", "A.wz", "d0.v"
  bool rotation = false;
  bool massless = false;
};

/// A column of history.csv.
struct Column {
  std::string name;
  int dof = 0;  ///< index of the physical degree of freedom; negative: absent
  bool velocity = false;

  /// Value of the column for physical u and v; 0 if the column has no degree of freedom.
  [[nodiscard]] double value(const Vector& u, const Vector& v) const {
    return dof < 0 ? 0.0 : (velocity ? v : u)[dof];
  }
};

/// Source of a load. temperature, initial_strain: of a member; preload: of a spring; support: displacement of a moving
/// support; support_rate: velocity and acceleration of a moving support, which act through dampers and mass.
enum class LoadKind : unsigned char {
  force,
  moment,
  distributed,
  weight,
  base,
  temperature,
  initial_strain,
  preload,
  support,
  support_rate
};

struct Load {
  std::string name;  ///< "gravity", "load 1", ...
  Combination direction;
  History history;  ///< includes the amplitude
  /// True: acts in the static start (initial = "static"): gravity, constants that have always acted, supports at t = 0.
  bool is_static = false;
  LoadKind kind = LoadKind::force;
  /// direction . u is a length times `direction_unit`; the history has the unit `history_unit`; their product is a force.
  Unit direction_unit{}, history_unit{1, 0, 0};
};

/// Typical magnitudes, to which absolute tolerances are relative. The name of each member gives its unit.
struct Scales {
  double displacement = 1.0, rotation = 1.0, velocity = 1.0, angular_velocity = 1.0, force = 1.0;
};

/// A change of state during a frictional start.
struct StageEvent {
  std::string stage;
  double fraction = 0.0;  ///< fraction of the stage, 0 to 1
  int contact = -1;       ///< index into Model::contacts
  State from = State::open, to = State::open;
};

/// Contact forces and states at the end of one step of a stage.
struct StageEnd {
  std::string stage;
  double fraction = 1.0;
  std::vector<State> states;
  std::vector<double> N, T;  ///< force
};

/// Result of the static start (initial = "static" or "frictional").
struct StaticStart {
  std::vector<double> reactions;  ///< -N of each contact, >= 0
  /// Motions without stiffness, and the contacts that restrain each: "horizontal motion held at contact 'first'".
  std::vector<std::string> free_motions;
  bool frictional = false;
  std::vector<StageEvent> events;  ///< only frictional
  std::vector<StageEnd> stages;    ///< only frictional
  /// Quantities of a frictional start that the data do not determine, one sentence each.
  std::vector<std::string> undetermined;
};

/// Force of a preloaded spring: cold (in the undeformed structure) and at t = 0.
struct HangerLoad {
  std::size_t spring = 0;  ///< number of the spring in the file, from 1
  double cold = 0.0, at_start = 0.0;
  std::optional<double> hot = {};  ///< hot load for which a hanger is designed
};

// Data for drawings of deformed shapes; empty in matrix scenes. dofs: indices of ux, uy, rz; -1 if fixed or absent.

/// A node of the mesh, including inner nodes of beams.
struct DrawnNode {
  std::string name;
  double x = 0.0, y = 0.0;
  int dofs[3] = {-1, -1, -1};
  bool named = true;  ///< true: named in the scene file
  bool held = false;  ///< true: fixed by a support
};

/// A beam, a bar, a spring between two nodes, a line of a rigid body's outline, or an edge of a mesh, with the degrees of
/// freedom of both ends.
struct DrawnElement {
  enum class Kind : unsigned char { beam, bar, spring, rigid, mesh };
  double x1 = 0.0, y1 = 0.0, x2 = 0.0, y2 = 0.0;
  int dofs[6] = {-1, -1, -1, -1, -1, -1};
  int nodes[2] = {-1, -1};  ///< indices into Model::drawn_nodes
  Kind kind = Kind::beam;
};

/// Position of a contact, its unit normal (nx, ny) and its unit tangent (tx, ty).
struct DrawnContact {
  int node = -1;
  double x = 0.0, y = 0.0;
  double nx = 0.0, ny = 0.0, tx = 0.0, ty = 0.0;
};

/// Contribution of the left-out modes to the static compliance of a form. This compliance is the displacement along the form
/// under a unit force along the form, without rigid-body motions. The reduced model includes this contribution, but not the
/// inertia of these modes.
struct ComplianceShare {
  std::string label;        ///< "normal of contact 'first'", "load 1"
  int contact = -1;         ///< index into Model::contacts; -1: a load
  bool normal = false;      ///< true: the contact's normal, false: its tangent
  double compliance = 0.0;  ///< compliance of all modes with stiffness
  double residual = 0.0;    ///< compliance of the modes that are left out
};

/// Basis of a reduced model: physical displacements = shapes * u, where u is the vector of reduced coordinates.
struct Reduction {
  std::vector<Dof> dofs;   ///< physical degrees of freedom, to which columns and drawing refer
  Eigen::MatrixXd shapes;  ///< physical x reduced; slip points of shear elements have no column
  /// |x_i|^T |K| |x_j| for each pair of shapes x_i, x_j; force/length. It bounds the error of x_i^T K x_j per unit relative
  /// error of the entries of K.
  Eigen::MatrixXd stiffness_terms;
  double cutoff = 0.0;                          ///< rad per time
  int modes = 0;                                ///< kept modes, rigid-body motions included
  int free_modes = 0;                           ///< kept modes without stiffness
  int truncated_modes = 0;                      ///< modes above the cutoff
  int massless_shapes = 0, massive_shapes = 0;  ///< shapes for the static compliance of the left-out modes
  /// Highest frequency of the kept modes, rad per time; 0: rigid-body motions only.
  double highest_kept = 0.0;
  double first_truncated = 0.0;         ///< lowest frequency above the cutoff, rad per time; 0: none
  double highest_massive = 0.0;         ///< highest frequency of the massive shapes, rad per time; 0: none
  std::vector<ComplianceShare> shares;  ///< shares of contacts, then of loads
  /// Largest amplitude, at named nodes, of the left-out modes after jumps of the loads; length.
  double ringing = 0.0;
  /// Largest part of the initial displacement (velocity) that the reduced model cannot represent. Rotations are converted to
  /// lengths by the ratio of the scales. Units: length, length/time.
  double initial_displacement_lost = 0.0, initial_velocity_lost = 0.0;
  std::optional<double> tolerance;  ///< tolerance from which the cutoff was determined
  std::vector<CutoffTrial> trials;

  [[nodiscard]] Vector physical(const Vector& u) const { return shapes * u.head(shapes.cols()); }
};

/// Motions of nodes tied to a rigid body's centre: x_tied = rows x + given terms, where x is the motion of the structure.
struct Ties {
  /// Physical degrees of freedom, in this order: structure, tied nodes, sliding points.
  std::vector<Dof> dofs;
  SparseMatrix rows;  ///< tied x structure
  /// Contribution of a moving support to one tied degree of freedom.
  struct Given {
    int tied = 0;
    History motion;
  };
  std::vector<Given> given;

  /// Motion of all degrees of freedom for the structure's motion x, without given terms.
  [[nodiscard]] Vector with_tied(const Vector& x) const {
    Vector result(x.size() + rows.rows());
    result << x.head(rows.cols()), rows * x.head(rows.cols()), x.tail(x.size() - rows.cols());
    return result;
  }
};

/// Correction of displacements and energy for a load that acts on massless parts with rigid contacts
/// (model/compliance_split.hpp).
struct LoadCorrection {
  std::size_t load = 0;  ///< index into Model::loads
  Vector displacements;  ///< correction of the structure's displacements, per unit of the load's history
  /// One entry per entry of Model::load_corrections, per unit of both histories; see correction_energy().
  Vector energies;
};

/// Result of run.geometric: Model::stiffness includes the geometric stiffness of the forces listed here.
struct Geometric {
  Prestress forces;
  /// Buckling load factors: the lowest multiples (> 0, ascending) of these forces at which the structure, with the contacts
  /// of the start, loses its stiffness against some motion. A factor <= 1: the structure is unstable. If no multiple > 0 exists,
  /// as in tension, the multiples < 0 nearest to zero, which act against these forces. Empty: none exists, or none was requested.
  std::vector<double> load_factors;
};

struct Model {
  std::string title;
  Units units;
  /// Size of the model's units of force, length and time in units of the scene: 1 except inside a run.
  Factors unit;
  /// Units of a run's computation: powers of two, chosen by build_model (model/internal_units.hpp).
  Factors internal_units;
  std::vector<Dof> dofs;
  SparseMatrix mass, damping, stiffness;
  std::vector<Load> loads;
  std::vector<Contact> contacts;
  ForceLayout layout;  ///< layout of the forces and guards of all contacts
  std::vector<Column> columns;
  std::vector<Output> outputs;
  /// Sum of reactions minus loads and inertia, along x and y; zero up to the residual of the equation of motion. Empty
  /// unless a reaction output is requested and the model is not reduced.
  std::vector<Output> reaction_sums;
  std::vector<DrawnElement> drawing;
  std::vector<DrawnNode> drawn_nodes;
  std::vector<DrawnContact> drawn_contacts;  ///< one per contact
  Vector u0, v0;                             ///< initial state (static equilibrium if requested)
  bool static_start = false;
  StaticStart statics;
  std::vector<HangerLoad> hangers;
  /// Contact states at the end of the run that this run continues, one per contact. Empty: this run continues
  /// no run of the same structure, or that run recorded no contacts.
  std::vector<SavedState::FinalContact> saved_contacts;
  /// Time of the state with which this run continues another one, in that run. Its resolution is that of the first instant,
  /// because the state may be that of an event. 0: this run continues none.
  double saved_time = 0.0;
  Scales scales;
  double alpha = 0.0, beta = 0.0;  ///< factors of the Rayleigh damping alpha M + beta K in `damping`
  double omega1 = 0.0;     ///< lowest circular frequency, with the initially closed contacts closed; 0: none
  double omega_max = 0.0;  ///< highest circular frequency with all contact springs acting
  std::optional<Reduction> reduction;
  /// Warnings about valid but suspicious input, one sentence each; every run begins its list of warnings with them.
  std::vector<std::string> warnings;
  /// Set if massless motions needed separate degrees of freedom (model/massless.hpp): displacements of the first degrees of
  /// freedom = basis * u.
  std::optional<SparseMatrix> basis;
  std::vector<LoadCorrection> load_corrections;
  std::optional<Ties> ties;  ///< rigid bodies and their tied nodes
  std::optional<Geometric> geometric;

  [[nodiscard]] int size() const { return static_cast<int>(dofs.size()); }
  /// Length of the vector of all contact forces.
  [[nodiscard]] Eigen::Index force_count() const { return static_cast<Eigen::Index>(layout.size()); }
  /// True if the computed displacements are those of physical_dofs().
  [[nodiscard]] bool is_physical() const { return !reduction && !basis && !ties; }
  /// Displacements (or velocities) of physical_dofs(), without terms of moving supports of rigid bodies and of
  /// LoadCorrection.
  [[nodiscard]] Vector physical(const Vector& u) const {
    const Vector x = structural(u);
    return ties ? ties->with_tied(x) : x;
  }
  /// Same as physical(u), but without the nodes tied to rigid bodies.
  [[nodiscard]] Vector structural(const Vector& u) const {
    Vector x = u;
    if (reduction)
      x = reduction->physical(u);
    else if (basis)
      x.head(basis->rows()) = *basis * u.head(basis->cols());
    return x;
  }
  /// Displacements (order 0) or velocities (order 1) of physical_dofs() at time t, all terms included.
  [[nodiscard]] Vector physical(const Vector& u, double t, int order) const {
    Vector x = structural(u);
    for (const LoadCorrection& seen : load_corrections) {
      const double value = loads[seen.load].history.piece(t).value(t, order);
      x.head(seen.displacements.size()) += value * seen.displacements;
    }
    if (!ties) return x;
    x = ties->with_tied(x);
    for (const Ties::Given& g : ties->given)
      x[ties->rows.cols() + g.tied] += g.motion.piece(t).value(t, order);
    return x;
  }
  /// Energy by which the structure's energy and the work of loads are lower than the computed values (LoadCorrection).
  [[nodiscard]] double correction_energy(double t) const {
    double sum = 0.0;
    for (const LoadCorrection& a : load_corrections)
      for (std::size_t j = 0; j < load_corrections.size(); ++j)
        sum += 0.5 * a.energies[static_cast<Eigen::Index>(j)] * loads[a.load].history.value(t) *
               loads[load_corrections[j].load].history.value(t);
    return sum;
  }
  /// Degrees of freedom to which columns and drawing refer.
  [[nodiscard]] const std::vector<Dof>& physical_dofs() const {
    return ties ? ties->dofs : reduction ? reduction->dofs : dofs;
  }
  /// True if the column is a rotation or an angular velocity.
  [[nodiscard]] bool is_rotation(const Column& column) const {
    return column.dof >= 0 && physical_dofs()[static_cast<std::size_t>(column.dof)].rotation;
  }
  /// Unit of a column as text, for example "m" or "rad/s".
  [[nodiscard]] std::string unit_of(const Column& column) const {
    const std::string of_motion = is_rotation(column) ? "rad" : units.length;
    return column.velocity ? of_motion + "/" + units.time : of_motion;
  }
};

/// Assembles matrices, frequencies, damping, initial state and scales. Errors: SceneError.
[[nodiscard]] Model build_model(const Scene& scene);

}  // namespace signorini
