// model.hpp: the scene as matrices.
//
//   M u'' + C u' + K u = P(t) - sum_k ( n_k N_k + t_k T_k ),   P(t) = sum_i d_i f_i(t)
//
// K holds no contact springs. Only degrees of freedom that exist and are not fixed are numbered;
// those whose row of M is zero are massless. Shapes: n degrees of freedom, all vectors of length n.
// In a reduced model (`reduction` is set) they are amplitudes of modes and of static shapes; contacts and
// loads are forms on those, columns and drawing refer to the physical degrees of freedom. Of a rigid body only
// its centre's degrees of freedom are numbered; those of nodes tied to it follow (`ties`).
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
  std::string displacement;  ///< "A.ux", "A.rz", "d0.u"; elements' inner nodes: "B-D.3.ux"
  std::string velocity;      ///< "A.vx", "A.wz", "d0.v"
  bool rotation = false;
  bool massless = false;
};

/// A column of history.csv.
struct Column {
  std::string name;
  int dof = 0;  ///< physical
  bool velocity = false;

  /// Its value in u and v of the physical degrees of freedom; 0 where it has none of them.
  [[nodiscard]] double of(const Vector& u, const Vector& v) const {
    return dof < 0 ? 0.0 : (velocity ? v : u)[dof];
  }
};

/// What a load comes from. temperature, initial_strain: of a member; preload: of a spring; support: where one that moves is;
/// support_rate: what its velocity and acceleration add, through dampers and mass.
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
  History history;  ///< amplitude included
  /// Counts for initial = "static": gravity, constants that hold since ever, where supports are at t = 0.
  bool is_static = false;
  LoadKind kind = LoadKind::force;
  /// direction . u is a length times `of_direction`, the history has `of_history`: together a force.
  Unit of_direction{}, of_history{1, 0, 0};
};

/// Typical magnitudes, from which absolute tolerances follow. Units in the names.
struct Scales {
  double displacement = 1.0, rotation = 1.0, velocity = 1.0, angular_velocity = 1.0, force = 1.0;
};

/// A change of state in a frictional start.
struct StageEvent {
  std::string stage;
  double part = 0.0;  ///< of the stage, 0 to 1
  int contact = -1;   ///< index into Model::contacts
  State from = State::open, to = State::open;
};

/// Contacts at the end of a part of a stage.
struct StageEnd {
  std::string stage;
  double part = 1.0;
  std::vector<State> states;
  std::vector<double> N, T;  ///< force
};

/// What the static start found (initial = "static" or "frictional").
struct StaticStart {
  std::vector<double> reactions;          ///< -N a contact, >= 0
  std::vector<std::string> free_motions;  ///< "horizontal motion held at contact 'first'"
  bool frictional = false;
  std::vector<StageEvent> events;   ///< frictional
  std::vector<StageEnd> stages;     ///< frictional
  std::vector<std::string> doubts;  ///< frictional: what the data leave open, one sentence each
};

/// A spring with a preload: what it bears before anything has moved, and at t = 0; force.
struct HangerLoad {
  std::size_t spring = 0;  ///< its number in the file, from 1 on
  double cold = 0.0, at_start = 0.0;
  std::optional<double> hot = {};  ///< as it was designed
};

// What deformed shapes are drawn from; empty in matrix scenes. dofs (ux, uy, rz): -1 where fixed or absent.

/// A node of the mesh, inner ones of beams included.
struct DrawnNode {
  std::string name;
  double x = 0.0, y = 0.0;
  int dofs[3] = {-1, -1, -1};
  bool named = true;  ///< stands in the scene file
  bool held = false;  ///< by a support
};

/// A beam, a bar, a spring between two nodes, a line of a rigid body's outline, or an edge of a mesh; dofs at both ends.
struct DrawnElement {
  enum class Kind : unsigned char { beam, bar, spring, rigid, mesh };
  double x1 = 0.0, y1 = 0.0, x2 = 0.0, y2 = 0.0;
  int dofs[6] = {-1, -1, -1, -1, -1, -1};
  int nodes[2] = {-1, -1};  ///< indices into Model::drawn_nodes
  Kind kind = Kind::beam;
};

/// Where a contact acts and along which unit vectors.
struct DrawnContact {
  int node = -1;
  double x = 0.0, y = 0.0;
  double nx = 0.0, ny = 0.0, tx = 0.0, ty = 0.0;
};

/// How much of a form's static compliance (displacement along it under a unit force along it, motions
/// without stiffness left aside) the modes that are left out have. It is kept, without inertia.
struct ComplianceShare {
  std::string what;         ///< "normal of contact 'first'", "load 1"
  int contact = -1;         ///< index into Model::contacts; -1: a load
  bool normal = false;      ///< of the contact, else its tangent
  double compliance = 0.0;  ///< of all modes with stiffness
  double residual = 0.0;    ///< of the modes that are left out
};

/// What a reduced model is made of, and the way back: physical displacements = shapes * u.
struct Reduction {
  std::vector<Dof> dofs;   ///< the physical ones, to which columns and drawing refer
  Eigen::MatrixXd shapes;  ///< physical x reduced; the slip points of shear elements have no column
  /// |x_i|^T |K| |x_j| of two shapes; force/length: so much times a rounding is x_i^T K x_j off where each entry of K is by
  /// one.
  Eigen::MatrixXd stiffness_terms;
  double cutoff = 0.0;                          ///< rad per time
  int modes = 0;                                ///< kept, free motions included
  int free_modes = 0;                           ///< of them, those without stiffness
  int left_out = 0;                             ///< modes above the cutoff
  int massless_shapes = 0, massive_shapes = 0;  ///< of the static compliance of the modes left out
  double highest_kept = 0.0;                    ///< rad per time; 0: free motions only
  double first_left_out = 0.0;                  ///< rad per time; 0: none
  double highest_massive = 0.0;                 ///< rad per time, of the massive shapes; 0: none
  std::vector<ComplianceShare> shares;          ///< contacts, then loads
  /// Amplitude at named nodes of what the modes left out would ring with after the loads' jumps; length.
  double ringing = 0.0;
  /// Greatest part of the initial displacement (velocity) that is lost; rotations as lengths, by the scales.
  double initial_displacement_lost = 0.0, initial_velocity_lost = 0.0;
  std::optional<double> tolerance;  ///< that the cutoff was found for, and what was tried
  std::vector<CutoffTrial> tried;

  [[nodiscard]] Vector physical(const Vector& u) const { return shapes * u.head(shapes.cols()); }
};

/// Motions of nodes that are tied to a rigid body's centre: x_tied = rows x + what supports give, x: of the structure.
struct Ties {
  std::vector<Dof> dofs;  ///< physical ones: of the structure, tied ones, points that slide
  SparseMatrix rows;      ///< tied x structure
  /// What a support that moves adds to one of them.
  struct Given {
    int tied = 0;
    History motion;
  };
  std::vector<Given> given;

  /// Of the motion x alone.
  [[nodiscard]] Vector with_tied(const Vector& x) const {
    Vector result(x.size() + rows.rows());
    result << x.head(rows.cols()), rows * x.head(rows.cols()), x.tail(x.size() - rows.cols());
    return result;
  }
};

/// What a load on parts with borrowed springs (model/borrowed_springs.hpp) adds to what is seen of the structure.
struct SeenLoad {
  std::size_t load = 0;  ///< index into Model::loads
  Vector displacements;  ///< of the structure's degrees of freedom, for a history of 1
  Vector energies;       ///< one for each of these loads, for histories of 1
};

/// Of run.geometric: Model::stiffness contains the stiffness of these forces.
struct Geometric {
  FrozenForces forces;
  /// Multiples of these forces under which some motion has no stiffness, on the contacts of the start: the lowest
  /// ones, ascending, > 0. Up to 1: the structure is unstable there. Empty: it never is, or nobody asked.
  std::vector<double> load_factors;
};

struct Model {
  std::string title;
  Units units;
  /// What one unit of force, length and time of the numbers here is in those: 1, but inside of a run.
  Factors unit;
  /// In which a run computes: powers of two, found by build_model (model/machine_units.hpp).
  Factors machine;
  std::vector<Dof> dofs;
  SparseMatrix mass, damping, stiffness;
  std::vector<Load> loads;
  std::vector<Contact> contacts;
  ForceLayout layout;  ///< of the forces of all contacts
  std::vector<Column> columns;
  std::vector<Output> outputs;
  /// Along x and y: reactions less what loads and inertia ask for; zero but for the residual of the equation
  /// of motion. Empty unless a reaction is asked for of a model that is not reduced.
  std::vector<Output> reaction_sums;
  std::vector<DrawnElement> drawing;
  std::vector<DrawnNode> drawn_nodes;
  std::vector<DrawnContact> drawn_contacts;  ///< one a contact
  Vector u0, v0;                             ///< initial state (static equilibrium where asked)
  bool static_start = false;
  StaticStart statics;
  std::vector<HangerLoad> hangers;
  /// Where the run left its contacts that this one goes on from, one a contact; empty: it goes on from none of the same
  /// structure, or that says nothing of them.
  std::vector<SavedState::Left> continues;
  Scales scales;
  double alpha = 0.0, beta = 0.0;  ///< Rayleigh factors in force
  double omega1 = 0.0;             ///< lowest circular frequency, initially closed contacts held; 0: none
  double omega_max = 0.0;          ///< highest circular frequency, all contacts held by their springs
  std::optional<Reduction> reduction;
  /// What the scene may say and hardly means, one sentence each; the first warnings of every run.
  std::vector<std::string> warnings;
  /// Where massless motions needed a degree of freedom of their own (model/undamped.hpp): displacements of
  /// the first degrees of freedom = basis * u.
  std::optional<SparseMatrix> basis;
  std::vector<SeenLoad> seen_loads;
  std::optional<Ties> ties;  ///< rigid bodies
  std::optional<Geometric> geometric;

  [[nodiscard]] int size() const { return static_cast<int>(dofs.size()); }
  /// Length of the vector of all contact forces.
  [[nodiscard]] Eigen::Index force_count() const {
    return static_cast<Eigen::Index>(layout.size(contacts.size()));
  }
  /// Whether displacements that are computed are those of physical_dofs().
  [[nodiscard]] bool is_physical() const { return !reduction && !basis && !ties; }
  /// Displacements (or velocities) of physical_dofs(), where no support moves a rigid body and no load is seen.
  [[nodiscard]] Vector physical(const Vector& u) const {
    const Vector x = structural(u);
    return ties ? ties->with_tied(x) : x;
  }
  /// The same without nodes that are tied.
  [[nodiscard]] Vector structural(const Vector& u) const {
    Vector x = u;
    if (reduction)
      x = reduction->physical(u);
    else if (basis)
      x.head(basis->rows()) = *basis * u.head(basis->cols());
    return x;
  }
  /// Displacements (order 0) or velocities (1) at time t.
  [[nodiscard]] Vector physical(const Vector& u, double t, int order) const {
    Vector x = structural(u);
    for (const SeenLoad& seen : seen_loads) {
      const double value = loads[seen.load].history.piece(t).value(t, order);
      x.head(seen.displacements.size()) += value * seen.displacements;
    }
    if (!ties) return x;
    x = ties->with_tied(x);
    for (const Ties::Given& g : ties->given)
      x[ties->rows.cols() + g.tied] += g.motion.piece(t).value(t, order);
    return x;
  }
  /// By so much energy of the structure and work of loads are less than those of what is computed.
  [[nodiscard]] double seen_energy(double t) const {
    double sum = 0.0;
    for (const SeenLoad& a : seen_loads)
      for (std::size_t j = 0; j < seen_loads.size(); ++j)
        sum += 0.5 * a.energies[static_cast<Eigen::Index>(j)] * loads[a.load].history.value(t) *
               loads[seen_loads[j].load].history.value(t);
    return sum;
  }
  /// To which columns and drawing refer.
  [[nodiscard]] const std::vector<Dof>& physical_dofs() const {
    return ties ? ties->dofs : reduction ? reduction->dofs : dofs;
  }
  /// Of a rotation, or of an angular velocity?
  [[nodiscard]] bool turns(const Column& column) const {
    return column.dof >= 0 && physical_dofs()[static_cast<std::size_t>(column.dof)].rotation;
  }
  /// "m", "rad/s"
  [[nodiscard]] std::string unit_of(const Column& column) const {
    const std::string of_motion = turns(column) ? "rad" : units.length;
    return column.velocity ? of_motion + "/" + units.time : of_motion;
  }
};

/// Assembles, finds frequencies, damping, initial state and scales. Errors: SceneError.
[[nodiscard]] Model build_model(const Scene& scene);

}  // namespace signorini
