// scene.hpp: a scene as described by its file, with all defaults filled in and all units checked.
//
//   M u'' + C u' + K u = P(t) - sum_k ( n_k N_k + t_k T_k )
//
// A Scene contains names, places and numbers, but no matrices. docs/scene.md is the reference of scene files.
//
//   Scene scene = read_scene("models/pipeline.toml", {{"run.rtol", "1e-10"}});
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "signorini/contact_law.hpp"
#include "signorini/engine.hpp"
#include "signorini/error.hpp"
#include "signorini/history.hpp"
#include "signorini/plane_mesh.hpp"
#include "signorini/user_contact_law.hpp"

namespace signorini {

/// Names of the units; the reader checks that force = mass * length / time^2.
struct Units {
  std::string force, mass, length, time;
};

/// Factors for units of force, length and time: positive, finite.
struct Factors {
  double force = 1.0, length = 1.0, time = 1.0;
};

/// Unit of a quantity: force^a length^b time^c, given by a, b, c; all zero: a plain number.
struct Unit {
  int force = 0, length = 0, time = 0;
};

enum class HistoryType { constant, step, rectangle, triangle, half_sine, harmonic, polynomial, table };

/// f(t) = offset + amplitude * shape(t). For loads offset is 0 and amplitude 1; LoadSpec::amplitude scales the history.
struct HistorySpec {
  HistoryType type = HistoryType::constant;
  double offset = 0.0;
  double amplitude = 1.0;
  double start = 0.0;
  double end = std::numeric_limits<double>::infinity();
  double omega = 0.0;                           ///< harmonic: rad per time
  double phase = 0.0;                           ///< harmonic: rad
  std::vector<double> coefficients = {};        ///< polynomial: ascending powers of (t - start)
  std::vector<double> times = {}, values = {};  ///< table
  bool steffen = false;                         ///< table: interpolation = "steffen"
  bool start_given = false;                     ///< false: a constant that has always acted
  bool hold = false;                            ///< table: after the last time the last value continues
  double shift = 0.0;                           ///< delay of the whole history
  double period = 0.0;                          ///< > 0: the shape restarts after each period, `rounds` times
  int rounds = 1;
  SourcePlace place = {};
  /// For scenes made in code: the shape itself, used instead of `type` and the keys of the type.
  std::optional<History> in_code = {};

  [[nodiscard]] static HistorySpec zero() {
    HistorySpec spec;
    spec.amplitude = 0.0;
    return spec;
  }
};

/// A direction in the space of displacements: a node with a plane vector, or degrees of freedom with factors, by name.
struct Direction {
  std::string node = {};
  std::array<double, 2> vector{0.0, 0.0};
  std::vector<std::pair<std::string, double>> dofs = {};
  SourcePlace place = {};
  /// Nodes of the opposite surface, with weights: their weighted displacements are subtracted from that of `node`.
  std::vector<std::pair<std::string, double>> against = {};
};

/// newmark: method that locates an event. root: repeats the step until the guard is zero at its end; linear: repeats it once.
enum class Refine { root, linear };
/// newmark: doubling searches for a step size such that doubling it changes the result by less than the tolerance.
enum class StepControl { fixed, doubling };
/// exact: method that computes the motion between events.
enum class Flow { automatic, modal, taylor };
/// Certification of a run (certify.hpp); automatic: only if the companion run is cheap.
enum class Certify { automatic, yes, no };
/// Type of companion run: with the exact flow, or with the same engine and a finer setting. automatic: chosen by cost.
enum class Companion { automatic, exact, finer };

/// Absolute tolerances; absent: rtol times a scale of the scene.
struct Tolerances {
  std::optional<double> displacement, velocity, force;
};

struct RunSpec {
  double t_end = 0.0;
  Engine engine = Engine::ida;
  double rtol = 1e-8;
  Tolerances atol = {};
  std::optional<double> output_dt = {};  ///< times of output: 0, dt, 2 dt, ..., t_end
  std::optional<std::vector<double>> output_times = {};
  std::vector<double> frames = {};    ///< times of deformed shapes, strictly ascending, in [0, t_end]
  std::optional<int> max_order = {};  ///< ida: 1 to 5; absent: the program chooses ("auto")
  int max_events_at_once = 100;       ///< limit for rounds of state changes at one instant
  /// newmark, friction-iteration: the time step; with doubling: the largest time step
  std::optional<double> dt = {};
  Refine refine = Refine::root;
  StepControl step = StepControl::fixed;
  Flow flow = Flow::automatic;
  Certify certify = Certify::automatic;
  Companion companion = Companion::automatic;
  /// ida; not a scene key: height of low flights in multiples of the tolerance; a finer companion run keeps the same height.
  double flight_tolerances = 1.0;
  double relaxation = 1.0;   ///< friction-iteration: relaxation factor of a bound, in (0, 1]
  int max_iterations = 100;  ///< friction-iteration: limit for iterations in each step
  bool geometric = false;    ///< true: adds the geometric stiffness of the static forces (Prestress)
  SourcePlace place = {};
  SourcePlace geometric_place = {};

  /// Times of history.csv: strictly ascending, t_end last. Errors: more than 1e8 times.
  [[nodiscard]] std::vector<double> grid() const;
};

/// A stage of a frictional start: the listed loads change slowly from their previous values to their values at t = 0.
struct StageSpec {
  std::string name;
  /// Names as in Model::loads; "temperature" or "supports" name all loads of that kind.
  std::vector<std::string> loads;
  int steps = 1;  ///< number of equal parts of the stage; the state is reported after each part
  SourcePlace place;
  std::vector<SourcePlace> load_places = {};  ///< one per load
};

/// Static forces whose geometric stiffness acts in the run (run.geometric).
struct Prestress {
  /// Axial force of a finite element at its two nodes, tension positive.
  struct Element {
    std::string from, to;
    double at_from = 0.0, at_to = 0.0;
  };
  /// Moment per rotation of a rigid body: sum of F . r over the forces F at positions r on the body.
  struct Body {
    std::string name;
    double stiffness = 0.0;
  };
  std::vector<Element> elements;
  std::vector<Body> bodies;
};

/// State at the end of a run, with all data needed to continue the motion in another run.
struct SavedState {
  std::string run;  ///< directory of the saved run
  /// Displacements, velocities and other columns, each with its name (scene/saved_state.hpp).
  std::vector<std::pair<std::string, double>> motions;
  std::vector<std::pair<std::string, double>> shears;  ///< T of contacts, by name of the contact
  std::vector<std::pair<std::string, int>> slips;      ///< slip direction -1, 0 or 1, by name of the contact
  struct UserLawMemory {
    std::string contact;
    std::size_t state = 0;  ///< state of the user law
    double memory = 0.0;    ///< p
  };
  std::vector<UserLawMemory> user_law_states;  ///< contacts with user laws
  double t = 0.0;                              ///< time of the state, in the time of the run that saved it
  /// A row of the saved run's contacts.csv at t. It is available even if states.csv lacks columns.
  struct FinalContact {
    std::string contact, state;
    std::optional<double> gap;
    double ut = 0.0, vt = 0.0, slip = 0.0, N = 0.0, T = 0.0;
  };
  std::vector<FinalContact> final_contacts;  ///< empty: contacts.csv has no such rows
  /// Scales (displacement, rotation, velocity, angular velocity, force) of the saved run, so that tolerances stay the same.
  std::optional<std::array<double, 5>> scales;
  std::optional<Prestress> prestress;  ///< static forces of the saved run, if it had run.geometric
  /// Normal forces of pendulums that are part of K in the saved run, by name of the contact.
  std::vector<std::pair<std::string, double>> pendulum_forces;
  /// Tables of the scene file in which the structure of the saved run differs from that of this scene.
  std::vector<std::string> structure_differences;
};

/// Initial state: "static", "frictional", the state of another run, or explicit values. Explicit values are given per degree
/// of freedom in the order of [matrices] dofs, or per node.
struct InitialSpec {
  bool is_static = false;
  bool is_frictional = false;
  std::vector<StageSpec> stages = {};  ///< frictional; empty: all static loads at once
  std::optional<SavedState> saved = {};
  std::vector<double> u = {}, v = {};  ///< matrices: one entry per degree of freedom; empty: zero
  struct Component {
    std::string node, component;  ///< component: ux uy rz vx vy wz
    double value = 0.0;
    SourcePlace place;
  };
  std::vector<Component> components = {};
  SourcePlace place = {};
};

/// C = alpha M + beta K. alpha_over_omega1 means alpha = alpha_over_omega1 * omega1. The reader converts damping ratios at
/// two frequencies to alpha and beta.
struct DampingSpec {
  double alpha = 0.0;
  double beta = 0.0;
  std::optional<double> alpha_over_omega1;
  SourcePlace place;
};

/// A trial run with one cutoff, in the search for a cutoff that satisfies a tolerance.
struct CutoffTrial {
  double cutoff_omega = 0.0;  ///< in rad per unit of time
  int modes = 0;              ///< number of kept modes
  /// Contribution of the left-out modes to the response, relative to the response (study/reduction).
  double missed = 0.0;
  /// Largest difference of displacements from the next trial, relative; 0: there is no next trial.
  double moved = 0.0;
  /// Error bound: `moved` plus the error of the next trial; `missed` if there is no next trial.
  double error = 0.0;
};

/// Modes up to the cutoff are kept; modes above it contribute only their static compliance (model/reduce/reduction.hpp).
struct ReductionSpec {
  double cutoff_omega = 0.0;        ///< rad per time; 0: not yet determined
  std::optional<double> tolerance;  ///< relative; if given, find_cutoff determines the cutoff from it
  std::vector<CutoffTrial> trials;  ///< trials of the search; the cutoff of the last trial is used
  SourcePlace place;
};

struct Section {
  std::string name;
  double EA = 0.0, EI = 0.0, mass_per_length = 0.0;  ///< EI = 0: the section is for bars only
  double area = 0.0, modulus = 0.0;                  ///< stresses: N / area, M / modulus; 0: unknown
  double pipe_radius = 0.0, pipe_wall = 0.0;         ///< mean radius and wall of a pipe; 0: not a pipe
};

struct Node {
  std::string name = {};
  double x = 0.0, y = 0.0;
  SourcePlace place = {};
  bool is_mesh_node = false;  ///< node of a body's mesh without a name in the scene: no column of history.csv
};

enum class MassKind { consistent, lumped };
enum class MemberType { beam, bar };

/// A bend: the pieces of the member are circular arcs.
struct Bend {
  double radius = 0.0;           ///< > 0: the arc turns left from node to node; < 0: right
  double flexibility = 1.0;      ///< EI is divided by this factor
  double intensification = 1.0;  ///< factor on bending stresses
};

/// A chain of pieces between named nodes; piece i consists of elements[i] beams, or of one bar.
struct Member {
  std::vector<std::string> nodes = {};
  std::string section = {};
  std::vector<int> elements = {};
  MemberType type = MemberType::beam;
  MassKind mass = MassKind::consistent;
  SourcePlace place = {};
  std::vector<std::string> release = {};             ///< end nodes with a hinge: first, last or both
  double thermal_expansion = 0.0;                    ///< strain per temperature
  HistorySpec temperature = HistorySpec::zero();     ///< temperature above that of the undeformed state
  HistorySpec initial_strain = HistorySpec::zero();  ///< along the member, positive: elongation
  std::optional<Bend> bend = {};                     ///< absent: straight pieces
};

/// A plane continuum body. Its nodes are in Scene::nodes, named NAME.NUMBER or by a point of the body.
struct BodySpec {
  std::string name = {};
  PlaneMesh mesh = {};  ///< mesh.nodes is empty; indices of nodes refer to Scene::nodes
  std::size_t first_node = 0, node_count = 0;
  double E = 0.0, nu = 0.0, density = 0.0, thickness = 1.0;
  bool plane_strain = false;  ///< true: plane strain; false: plane stress
  MassKind mass = MassKind::consistent;
  double thermal_expansion = 0.0;                 ///< strain per temperature
  HistorySpec temperature = HistorySpec::zero();  ///< temperature above that of the undeformed state
  std::vector<int> massless = {};  ///< nodes whose mass is moved to other nodes (contact_mass = "none")
  SourcePlace place = {};
};

/// A node of a boundary in a scene of [matrices]: position, and names of its degrees of freedom; empty: fixed.
struct SurfaceNode {
  double x = 0.0, y = 0.0;
  std::string ux = {}, uy = {};
};
struct SurfaceSpec {
  std::string name = {};
  std::vector<PlaneMesh::Edge> edges = {};  ///< indices into Scene::surface_nodes
  double thickness = 1.0;
  SourcePlace place = {};
};

/// A node of a seam; there is one contact in Scene::contacts for each node, in the same order.
struct SeamNode {
  int node = 0;                            ///< index into Scene::nodes, or Scene::surface_nodes
  std::array<double, 2> at{0.0, 0.0};      ///< position of the node
  double length = 0.0;                     ///< arc length attributed to the node
  std::array<double, 2> normal{0.0, 0.0};  ///< direction in which the contact opens; the tangent is (ny, -nx)
};
/// Contact between the surfaces of bodies, or with the ground: contacts NAME.1, NAME.2, ... along the arc.
struct SeamSpec {
  std::string name = {};
  std::size_t first_contact = 0;
  std::vector<SeamNode> nodes = {};
  double thickness = 1.0;
  SourcePlace place = {};
};

/// A node whose displacements follow other nodes along x and y, u = sum_l w_l u_l; from a seam with law = "tied".
struct TieSpec {
  std::string seam = {};
  int node = 0;                                     ///< index into Scene::nodes
  std::vector<std::pair<int, double>> master = {};  ///< indices l into Scene::nodes, with the weights w_l
  SourcePlace place = {};
};

struct PointMass {
  std::string node = {};
  double mass = 0.0;
  double inertia = 0.0;  ///< moment of inertia; the node must have a rotation
  SourcePlace place = {};
  std::string key = {};  ///< scene key for messages, "rigid.block"; empty: masses.NUMBER
};

/// Nodes that move rigidly with a centre c, u = u_c + rz x (r - r_c). The body's mass is an entry of Scene::masses.
struct RigidBody {
  std::string name = {};
  std::string centre = {};              ///< name of the centre, a node
  std::vector<std::string> nodes = {};  ///< all nodes except the centre
  SourcePlace place = {};
};

/// Spring and damper along `direction` between the nodes `node` and `against`; `against` empty: the ground.
struct Spring {
  std::string node, against;
  std::array<double, 2> direction{1.0, 0.0};  ///< normalised by the reader
  double stiffness = 0.0, damping = 0.0;
  SourcePlace place = {};
  double rotation_stiffness = 0.0, rotation_damping = 0.0;  ///< moment per rad, and per rad per time
  double preload = 0.0;                                     ///< force in the undeformed structure
  std::optional<double> hot_load = {};                      ///< designed hot load of a spring hanger
  bool restoring = false;  ///< restoring spring N / R of a pendulum, which damping beta K does not include
};

struct Support {
  std::string node = {};
  bool ux = false, uy = false, rz = false;
  SourcePlace place = {};
  /// Prescribed motion of the only fixed degree of freedom; absent: the support does not move.
  std::optional<HistorySpec> motion = {};
  bool motion_is_acceleration = false;  ///< true: `motion` is the acceleration; motion starts from rest
  std::string key = "supports";         ///< scene key for messages, "supports.3"
};

/// Coefficients of friction of a contact, or the default of a scene.
struct Friction {
  double static_ = 0.0;  ///< |T| <= static_ |N| in stick
  /// |T| = kinetic |N| in slip. Friction that rises with the slip rate: the limit for fast slip, at least static_.
  double kinetic = 0.0;
  /// f = kinetic + (static - kinetic) exp(-|p'| / stribeck_velocity) in slip
  std::optional<double> stribeck_velocity = {};
  /// f = fast - (fast - slow) exp(-|p'| / velocity) in slip; here static_ is slow, kinetic is fast
  std::optional<double> velocity = {};
  /// f = heavy + (light - heavy) exp(-|N| / force), in stick and in slip; here static_ is light, kinetic is heavy
  std::optional<double> force = {};

  [[nodiscard]] bool any() const { return static_ > 0.0; }
  /// True if friction grows with the slip rate, from static_ at rate 0: no jump of the force at the start of slip.
  [[nodiscard]] bool is_rate_strengthening() const { return velocity.has_value(); }
  /// True if friction depends on the slip rate; the equations of a slipping contact are then nonlinear.
  [[nodiscard]] bool is_rate_dependent() const { return stribeck_velocity || velocity; }
  /// True if the coefficient depends on the normal force.
  [[nodiscard]] bool is_load_dependent() const { return force.has_value(); }
  /// True if friction drops from the static to the kinetic value when slip begins.
  [[nodiscard]] bool has_static_drop() const {
    return static_ > kinetic && !is_rate_dependent() && !is_load_dependent();
  }
  /// Velocity constant of the exponential; only valid if is_rate_dependent().
  [[nodiscard]] double decay_velocity() const { return velocity ? *velocity : stribeck_velocity.value(); }
};

/// A constant of friction in addition to the two coefficients: its key in the table `friction`, its member and its unit.
struct FrictionConstant {
  std::string_view key;
  std::optional<double> Friction::*value;
  Unit unit;
};
inline constexpr std::array friction_constants = {
    FrictionConstant{"stribeck_velocity", &Friction::stribeck_velocity, {0, 1, -1}},
    FrictionConstant{"velocity", &Friction::velocity, {0, 1, -1}},
    FrictionConstant{"force", &Friction::force, {1, 0, 0}}};

/// A curved surface under a varying normal force: the restoring force is |N| ut / radius. Its constant part, with
/// nominal_force in place of |N|, is in K (contact/curved_surface.hpp).
struct CurvedSurface {
  double radius = 0.0, nominal_force = 0.0;
};

struct ContactSpec {
  std::string name = {};
  Law law = Law::compliant;
  std::optional<Direction> normal = {};   ///< direction of N; scenes with nodes: unit vector
  std::optional<Direction> tangent = {};  ///< absent in scenes with nodes and a normal: (ny, -nx)
  double gap = 0.0;
  double normal_stiffness = 0.0;
  std::optional<double> tangential_stiffness = {};
  double normal_damping = 0.0;      ///< dashpot parallel to the normal spring, >= 0
  double tangential_damping = 0.0;  ///< dashpot parallel to the tangential spring, >= 0
  Friction friction = {};
  HistorySpec normal_force = HistorySpec::zero();      ///< slider: compressive force, >= 0
  HistorySpec surface_velocity = HistorySpec::zero();  ///< slip rate = t . v - surface_velocity
  double initial_shear = 0.0;
  double restitution = 0.0;  ///< rigid: Newton's coefficient, 0 to 1
  /// rigid: the contact stays closed after a rebound slower than this velocity; absent: the limit follows from the tolerances
  std::optional<double> capture_velocity = {};
  SourcePlace place = {};
  /// Surface of a friction pendulum. Its stiffness nominal_force / radius is an entry of Scene::springs.
  std::optional<CurvedSurface> pendulum_surface = {};
  std::string table = {};  ///< scene table, "contacts.first", "stops.guide"; empty: contacts.NAME
  bool of_stop = false;
  /// User law, from law = "yielding" or made in code: data (user_contact_law.hpp) or a class (contact_law.hpp). It replaces the
  /// rows, guards and transitions of `law`, and determines N in the same way: by a spring, by an impulse, or N is given.
  std::optional<ContactLawPtr> user_law = {};
  /// See ForceLayout::Counts; results do not depend on these numbers.
  std::uint32_t unused_forces = 0, unused_guards = 0;

  /// Capabilities of `law`.
  [[nodiscard]] LawCapabilities capabilities() const { return capabilities_of(law); }
  [[nodiscard]] ContactLawPtr contact_law() const { return user_law.value_or(law); }
  /// Direction along which N acts; nullptr if the scene gives N itself, or no direction.
  [[nodiscard]] const Direction* bearing_normal() const {
    return normal && !capabilities().normal_force_given ? &*normal : nullptr;
  }
  /// Scene key in messages: "contacts.first.gap", "stops.guide.direction".
  [[nodiscard]] std::string key(const std::string& of) const {
    return (table.empty() ? "contacts." + name : table) + "." +
           (of_stop && of == "normal" ? "direction" : of);
  }
};

/// Ground acceleration along a direction; displacements are relative to the base. The load is -M r a(t).
struct BaseMotionSpec {
  Direction direction;  ///< r: equal for all nodes (its node is empty), or given by degree of freedom
  HistorySpec acceleration;
  SourcePlace place;
};

enum class LoadType { force, moment, distributed, traction };

/// A force or a moment at a node, a force per length on pieces of members, or a traction on a boundary of a body.
struct LoadSpec {
  Direction direction = {};  ///< moment: contains only the node
  double amplitude = 0.0;
  HistorySpec history = {};
  SourcePlace place = {};
  std::string name = {};  ///< name in results and stages; empty: "load" and the number of the load, "load 1"
  LoadType type = LoadType::force;
  std::vector<std::string> pieces = {};  ///< distributed: each two consecutive nodes bound a piece
  bool member_axes = false;  ///< distributed: direction in the axes of the piece (along, to the left)
  std::string group = {};    ///< traction: "BODY.GROUP"
  bool pressure = false;     ///< traction: true: acts against the outward normal instead of along `direction`
};

/// Kind of an [[output]], with a row in all_output_kinds.
enum class OutputKind : unsigned char {
  displacement,
  velocity,
  acceleration,
  relative,
  member_force,
  stress,
  envelope,
  reaction,
  spring,
  contact,
  combination
};
/// Quantity of an output. Members have N, V, M and stress; bodies have xx, yy and xy; contacts have N, T, gap, slip and loss.
enum class OutputQuantity : unsigned char { none, N, V, M, T, gap, slip, loss, stress, xx, yy, xy };
/// True if the quantity is a component of the stress at a node of a body.
[[nodiscard]] constexpr bool is_body_stress(OutputQuantity q) {
  return q == OutputQuantity::xx || q == OutputQuantity::yy || q == OutputQuantity::xy;
}
/// Extreme fibre of a section, left or right as seen from node to node along the member, or both.
enum class Fibre : unsigned char { both, left, right };

struct OutputKindName {
  OutputKind kind;
  const char* name;     ///< name in scene files
  const char* meaning;  ///< text for the documentation
};
inline constexpr std::array all_output_kinds = {
    OutputKindName{OutputKind::displacement, "displacement", "of a node along a direction"},
    OutputKindName{OutputKind::velocity, "velocity", "of a node along a direction"},
    OutputKindName{OutputKind::acceleration, "acceleration",
                   "of a node along a direction, absolute: includes the acceleration of the base"},
    OutputKindName{OutputKind::relative, "relative",
                   "displacement of the first node minus that of the second, along a direction"},
    OutputKindName{OutputKind::member_force, "member_force",
                   "N, V or M of the piece of a member between two nodes, at a station"},
    OutputKindName{OutputKind::stress, "stress",
                   "N / area +- M / modulus of the piece of a member between two nodes, at a station; or a "
                   "component of the stress at a node of a body"},
    OutputKindName{OutputKind::envelope, "envelope",
                   "greatest magnitude of N, V, M or stress along pieces of members"},
    OutputKindName{OutputKind::reaction, "reaction",
                   "force (or moment) of the supports of a node on the structure"},
    OutputKindName{OutputKind::spring, "spring",
                   "force (or moment) in a spring, including its preload and its damper"},
    OutputKindName{OutputKind::contact, "contact", "N, T, gap, slip or loss of a contact"},
    OutputKindName{OutputKind::combination, "combination", "sum of other outputs, each times a factor"},
};

/// A term of a combination.
struct OutputTerm {
  std::string name;  ///< name of an earlier output
  double factor = 1.0;
  Unit unit = {};  ///< unit of the factor
};

/// A response quantity: a column of response.csv.
struct OutputSpec {
  std::string name;
  OutputKind kind = OutputKind::displacement;
  /// Nodes, or a contact; envelope: each two consecutive nodes are the ends of a piece.
  std::vector<std::string> at;
  Direction direction;    ///< unit vector, or dofs with factors; stress of a body: the axis x
  bool rotation = false;  ///< true: the output is a rotation, and `direction` is not used
  OutputQuantity quantity = OutputQuantity::none;
  double station = 0.0;           ///< member_force, stress: position on the piece, 0 at at[0], 1 at at[1]
  std::size_t spring = 0;         ///< index into Scene::springs
  std::vector<OutputTerm> terms;  ///< the output is the sum of these terms
  SourcePlace place;
  Fibre fibre = Fibre::both;                   ///< fibre of a stress
  std::optional<double> intensification = {};  ///< bending stress factor; absent: factor of the bend, or 1
};

/// Triplets (row, column, value); of symmetric matrices both triangles are stored.
struct MatrixSpec {
  int size = 0;
  struct Entry {
    int row, column;
    double value;
  };
  std::vector<Entry> entries;
  SourcePlace place;
};

struct MatricesSpec {
  std::vector<std::string> dofs;
  MatrixSpec mass, damping, stiffness;
};

struct Scene {
  std::string file;
  std::string title;
  Units units;
  std::array<double, 2> gravity{0.0, 0.0};
  RunSpec run;
  InitialSpec initial;
  DampingSpec damping;
  std::vector<Section> sections;
  std::vector<Node> nodes;
  std::vector<Member> members;
  std::vector<BodySpec> bodies;
  std::vector<SurfaceSpec> surfaces;       ///< used only with matrices
  std::vector<SurfaceNode> surface_nodes;  ///< nodes of all surfaces, each listed once
  std::vector<SeamSpec> seams;             ///< tied seams are in `ties`
  std::vector<TieSpec> ties;
  std::vector<PointMass> masses;
  std::vector<RigidBody> rigid;
  std::vector<Spring> springs;
  std::vector<Support> supports;
  std::vector<ContactSpec> contacts;
  std::vector<LoadSpec> loads;
  std::vector<BaseMotionSpec> base_motion;
  std::vector<OutputSpec> outputs;
  std::optional<MatricesSpec> matrices;
  std::optional<ReductionSpec> reduction;
  std::string resolved;  ///< the same scene as TOML, with all defaults filled in (run.toml)
};

/// One change of a scene key, `--set path=value`.
struct Override {
  std::string path, value;
  /// Text of the override in messages, as the user typed it; empty: --set path=value.
  std::string shown_as = {};
};

/// Reads, checks and completes a scene. Errors: SceneError (with place and key); FileError; UsageError for an invalid
/// override.
[[nodiscard]] Scene read_scene(const std::string& path, const std::vector<Override>& overrides = {});
/// Reads a scene from a text in memory. `file` is used in messages, and matrix files are searched in its directory.
[[nodiscard]] Scene parse_scene(const std::string& text, const std::string& file,
                                const std::vector<Override>& overrides = {});

}  // namespace signorini
