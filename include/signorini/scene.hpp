// scene.hpp: a scene as its file describes it, with all defaults filled in and all units checked.
//
//   M u'' + C u' + K u = P(t) - sum_k ( n_k N_k + t_k T_k )
//
// A Scene contains names, places and numbers, no matrices. docs/scene.md is its reference.
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

/// Names of units; checked: force = mass * length / time^2.
struct Units {
  std::string force, mass, length, time;
};

/// Factors for units of force, length and time: positive, finite.
struct Factors {
  double force = 1.0, length = 1.0, time = 1.0;
};

/// Unit of a quantity: force^a length^b time^c; all zero: a plain number.
struct Unit {
  int force = 0, length = 0, time = 0;
};

enum class HistoryType { constant, step, rectangle, triangle, half_sine, harmonic, polynomial, table };

/// f(t) = offset + amplitude * shape(t). In a load's history offset is 0 and amplitude 1; LoadSpec has the load's amplitude.
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
  bool start_given = false;                     ///< false: a constant has always acted
  bool hold = false;                            ///< table: the last value stays after the last time
  double shift = 0.0;                           ///< delay of the whole history
  double period = 0.0;                          ///< > 0: the shape restarts after each period, `rounds` times
  int rounds = 1;
  SourcePlace place = {};
  /// For scenes made in code: this history is the shape, regardless of the type and its keys.
  std::optional<History> in_code = {};

  [[nodiscard]] static HistorySpec zero() {
    HistorySpec spec;
    spec.amplitude = 0.0;
    return spec;
  }
};

/// A direction in the space of displacements: a node and a plane vector, or degrees of freedom by name.
struct Direction {
  std::string node = {};
  std::array<double, 2> vector{0.0, 0.0};
  std::vector<std::pair<std::string, double>> dofs = {};
  SourcePlace place = {};
  /// Nodes whose weighted displacements are subtracted: the counterpart that the node touches.
  std::vector<std::pair<std::string, double>> against = {};
};

/// newmark: method of locating an event in time. root: the step is repeated until the guard at its end is zero; linear:
/// the step is repeated once, up to the interpolated time.
enum class Refine { root, linear };
/// newmark: doubling adapts the step: a step of twice the size must change the result by less than the tolerance.
enum class StepControl { fixed, doubling };
/// exact: method that computes the motion between events.
enum class Flow { automatic, modal, taylor };
/// Certification of a run (certify.hpp); automatic: the run is certified if this costs little.
enum class Certify { automatic, yes, no };
/// Type of companion run: the exact flow, or the same engine with a finer setting.
enum class Companion { automatic, exact, finer };

/// Absolute tolerances; the default of each is rtol times a scale of the scene.
struct Tolerances {
  std::optional<double> displacement, velocity, force;
};

struct RunSpec {
  double t_end = 0.0;
  Engine engine = Engine::ida;
  double rtol = 1e-8;
  Tolerances atol = {};
  std::optional<double> output_dt = {};  ///< grid 0, dt, 2 dt, ..., t_end
  std::optional<std::vector<double>> output_times = {};
  std::vector<double> frames = {};    ///< times of deformed shapes, strictly ascending, in [0, t_end]
  std::optional<int> max_order = {};  ///< ida: 1 to 5; absent: "auto"
  int max_events_at_once = 100;       ///< rounds of state changes at one instant before the run stops
  /// newmark, friction-iteration: the step; with step = doubling: the largest step
  std::optional<double> dt = {};
  Refine refine = Refine::root;
  StepControl step = StepControl::fixed;
  Flow flow = Flow::automatic;
  Certify certify = Certify::automatic;
  Companion companion = Companion::automatic;
  /// ida, no key: limit for low flights, in multiples of the tolerance (a finer companion uses the run's tolerance).
  double flight_tolerances = 1.0;
  double relaxation = 1.0;   ///< friction-iteration: relaxation factor of a bound, in (0, 1]
  int max_iterations = 100;  ///< friction-iteration: limit for each step; beyond it the run stops
  bool geometric = false;    ///< static forces have a geometric stiffness (Prestress)
  SourcePlace place = {};
  SourcePlace geometric_place = {};

  /// Times of history.csv: strictly ascending, t_end last. Errors: more than 1e8 times.
  [[nodiscard]] std::vector<double> grid() const;
};

/// A stage of a frictional start: these loads grow slowly from their previous values to their values at t = 0.
struct StageSpec {
  std::string name;
  /// Names as in Model::loads, or "temperature", "supports" for all loads of that kind.
  std::vector<std::string> loads;
  int steps = 1;  ///< number of parts of the stage; the state is reported after each
  SourcePlace place;
  std::vector<SourcePlace> load_places = {};  ///< one per load
};

/// Static forces whose geometric stiffness acts in a run (run.geometric).
struct Prestress {
  /// Axial force of a finite element at its two nodes, tension positive.
  struct Element {
    std::string from, to;
    double at_from = 0.0, at_to = 0.0;
  };
  /// Moment per rotation of a rigid body: sum of F . r over the forces on it.
  struct Body {
    std::string name;
    double stiffness = 0.0;
  };
  std::vector<Element> elements;
  std::vector<Body> bodies;
};

/// State at the end of a run: all data needed to continue its motion.
struct SavedState {
  std::string run;  ///< directory
  /// By name: displacements, velocities and other columns (scene/saved_state.hpp).
  std::vector<std::pair<std::string, double>> motions;
  std::vector<std::pair<std::string, double>> shears;  ///< T of contacts by name
  std::vector<std::pair<std::string, int>> slips;      ///< slip direction of contacts by name: -1, 0, 1
  struct UserLawMemory {
    std::string contact;
    std::size_t state = 0;  ///< state of the user law
    double memory = 0.0;    ///< p
  };
  std::vector<UserLawMemory> user_law_states;  ///< contacts with user laws
  double t = 0.0;                              ///< time of the state, in the run's time
  /// A row of the run's contacts.csv at t; it does not depend on the columns of states.csv.
  struct FinalContact {
    std::string contact, state;
    std::optional<double> gap;
    double ut = 0.0, vt = 0.0, slip = 0.0, N = 0.0, T = 0.0;
  };
  std::vector<FinalContact> final_contacts;  ///< empty: contacts.csv has no such rows
  /// Scales that keep the tolerances and the rest limit of the run: displacement, rotation, velocity, angular velocity, force.
  std::optional<std::array<double, 5>> scales;
  std::optional<Prestress> prestress;  ///< forces of the run, if it had run.geometric
  /// Carried loads of pendulums in the run's K, by name.
  std::vector<std::pair<std::string, double>> pendulum_forces;
  /// Tables in which the structure of the run's scene differs from this scene's.
  std::vector<std::string> structure_differences;
};

/// Initial state: "static", "frictional", the state of another run, or values by node or by [matrices] dofs (in this order).
struct InitialSpec {
  bool is_static = false;
  bool is_frictional = false;
  std::vector<StageSpec> stages = {};  ///< frictional; empty: all static loads at once
  std::optional<SavedState> saved = {};
  std::vector<double> u = {}, v = {};  ///< matrices: one per degree of freedom; empty: zero
  struct Component {
    std::string node, component;  ///< component: ux uy rz vx vy wz
    double value = 0.0;
    SourcePlace place;
  };
  std::vector<Component> components = {};
  SourcePlace place = {};
};

/// C = alpha M + beta K; alpha_over_omega1, if given: alpha / omega1. The reader converts damping ratios to alpha and beta.
struct DampingSpec {
  double alpha = 0.0;
  double beta = 0.0;
  std::optional<double> alpha_over_omega1;
  SourcePlace place;
};

/// A trial run with one cutoff, during the search for a tolerance.
struct CutoffTrial {
  double cutoff_omega = 0.0;  ///< rad per time
  int modes = 0;              ///< number of kept modes
  double missed = 0.0;  ///< relative contribution of the omitted modes to the response (study/reduction)
  double moved = 0.0;  ///< largest relative difference of displacements from the next trial; 0: no next trial
  /// Error bound: `moved` plus the error bound of the next trial; `missed` if there is no next trial.
  double error = 0.0;
};

/// Modes up to the cutoff are kept; for the others only their static compliance (model/reduce/reduction.hpp).
struct ReductionSpec {
  double cutoff_omega = 0.0;        ///< rad per time; 0 until it is found
  std::optional<double> tolerance;  ///< relative; find_cutoff sets the cutoff
  std::vector<CutoffTrial> trials;  ///< the last one is used
  SourcePlace place;
};

struct Section {
  std::string name;
  double EA = 0.0, EI = 0.0, mass_per_length = 0.0;  ///< EI = 0: only for bars
  double area = 0.0, modulus = 0.0;                  ///< stresses are N / area, M / modulus; 0: unknown
  double pipe_radius = 0.0, pipe_wall = 0.0;         ///< mean radius and wall of a pipe; 0: not a pipe
};

struct Node {
  std::string name = {};
  double x = 0.0, y = 0.0;
  SourcePlace place = {};
  bool of_mesh = false;  ///< node of a body's mesh without a name in the scene: no column of history.csv
};

enum class MassKind { consistent, lumped };
enum class MemberType { beam, bar };

/// A bend: the pieces of the member are arcs.
struct Bend {
  double radius = 0.0;           ///< > 0: the arc turns left on its way from node to node
  double flexibility = 1.0;      ///< EI is divided by it
  double intensification = 1.0;  ///< factor of bending stresses
};

/// A chain of pieces between named nodes; piece i has elements[i] beams, or one bar.
struct Member {
  std::vector<std::string> nodes = {};
  std::string section = {};
  std::vector<int> elements = {};
  MemberType type = MemberType::beam;
  MassKind mass = MassKind::consistent;
  SourcePlace place = {};
  std::vector<std::string> release = {};             ///< first or last node, or both, with a hinge
  double thermal_expansion = 0.0;                    ///< strain per temperature
  HistorySpec temperature = HistorySpec::zero();     ///< difference from the undeformed state
  HistorySpec initial_strain = HistorySpec::zero();  ///< along the member, positive: elongation
  std::optional<Bend> bend = {};                     ///< absent: straight pieces
};

/// A plane continuum. Its nodes are in Scene::nodes, called NAME.NUMBER or by the name of a point of the body.
struct BodySpec {
  std::string name = {};
  PlaneMesh mesh = {};  ///< without nodes: indices refer to Scene::nodes
  std::size_t first_node = 0, node_count = 0;
  double E = 0.0, nu = 0.0, density = 0.0, thickness = 1.0;
  bool plane_strain = false;  ///< plane strain; false: plane stress
  MassKind mass = MassKind::consistent;
  double thermal_expansion = 0.0;                 ///< strain per temperature
  HistorySpec temperature = HistorySpec::zero();  ///< difference from the undeformed state
  std::vector<int> massless = {};  ///< nodes whose mass is moved to others (contact_mass = "none")
  SourcePlace place = {};
};

/// A node of a boundary in a scene of [matrices]: coordinates, and names of its degrees of freedom; empty name: fixed.
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

/// A node of a seam. The i-th node of a seam belongs to Scene::contacts[first_contact + i].
struct SeamNode {
  int node = 0;                            ///< index into Scene::nodes, or Scene::surface_nodes
  std::array<double, 2> at{0.0, 0.0};      ///< place of the node
  double length = 0.0;                     ///< tributary arc length
  std::array<double, 2> normal{0.0, 0.0};  ///< opening direction; the tangent is (ny, -nx)
};
/// Contact of body surfaces with each other or with the ground: contacts NAME.1, NAME.2, ... along the arc.
struct SeamSpec {
  std::string name = {};
  std::size_t first_contact = 0;
  std::vector<SeamNode> nodes = {};
  double thickness = 1.0;
  SourcePlace place = {};
};

/// A node tied to master nodes, u = sum_l w_l u_l along x and y; the reader makes it from a seam with law = "tied".
struct TieSpec {
  std::string seam = {};
  int node = 0;                                     ///< index into Scene::nodes
  std::vector<std::pair<int, double>> master = {};  ///< indices into Scene::nodes, and w_l
  SourcePlace place = {};
};

struct PointMass {
  std::string node = {};
  double mass = 0.0;
  double inertia = 0.0;  ///< rotational; needs a rotation at the node
  SourcePlace place = {};
  std::string key = {};  ///< key for messages, "rigid.block"; empty: masses.NUMBER
};

/// Nodes that move rigidly with a centre, u = u_c + rz x (r - r_c); the body's mass is one of Scene::masses.
struct RigidBody {
  std::string name = {};
  std::string centre = {};              ///< a node
  std::vector<std::string> nodes = {};  ///< all other nodes
  SourcePlace place = {};
};

/// Spring and damper along `direction` between node and `against` (ground if empty).
struct Spring {
  std::string node, against;
  std::array<double, 2> direction{1.0, 0.0};  ///< normalised by the reader
  double stiffness = 0.0, damping = 0.0;
  SourcePlace place = {};
  double rotation_stiffness = 0.0, rotation_damping = 0.0;  ///< moment per rad, and per rad per time
  double preload = 0.0;                                     ///< force in the undeformed structure
  std::optional<double> hot_load = {};                      ///< designed hot load of a spring hanger
};

struct Support {
  std::string node = {};
  bool ux = false, uy = false, rz = false;
  SourcePlace place = {};
  /// Prescribed motion of the single fixed degree of freedom; absent: no motion.
  std::optional<HistorySpec> motion = {};
  bool motion_is_acceleration = false;  ///< `motion` is its second derivative, starting from rest at zero
  std::string key = "supports";         ///< key for messages, "supports.3"; one table may hold many nodes
};

/// Coefficients of friction, of a scene and of its contacts.
struct Friction {
  double static_ = 0.0;  ///< |T| <= static |N| in stick
  /// |T| = kinetic |N| in slip; for rising friction: the limit for fast slip, at least static_
  double kinetic = 0.0;
  /// f = kinetic + (static - kinetic) exp(-|p'| / stribeck_velocity) while slipping
  std::optional<double> stribeck_velocity = {};
  /// f = fast - (fast - slow) exp(-|p'| / velocity) while slipping; static_ is slow, kinetic is fast
  std::optional<double> velocity = {};
  /// f = heavy + (light - heavy) exp(-|N| / force), in stick and in slip; static_ is light, kinetic is heavy
  std::optional<double> force = {};

  [[nodiscard]] bool any() const { return static_ > 0.0; }
  /// True if friction grows with the slip rate, starting at static_: no jump at the start of slip.
  [[nodiscard]] bool is_rate_strengthening() const { return velocity.has_value(); }
  /// True if friction depends on the slip rate: slip is nonlinear.
  [[nodiscard]] bool is_rate_dependent() const { return stribeck_velocity || velocity; }
  /// True if the coefficient depends on the normal force.
  [[nodiscard]] bool is_load_dependent() const { return force.has_value(); }
  /// True if friction drops at the start of slip.
  [[nodiscard]] bool has_static_drop() const {
    return static_ > kinetic && !is_rate_dependent() && !is_load_dependent();
  }
  /// Velocity constant of the exponential. Precondition: is_rate_dependent().
  [[nodiscard]] double decay_velocity() const { return velocity ? *velocity : stribeck_velocity.value(); }
};

/// A constant of friction besides the two coefficients: its key in the table `friction`, its member and its unit.
struct FrictionConstant {
  std::string_view key;
  std::optional<double> Friction::*value;
  Unit unit;
};
inline constexpr std::array friction_constants = {
    FrictionConstant{"stribeck_velocity", &Friction::stribeck_velocity, {0, 1, -1}},
    FrictionConstant{"velocity", &Friction::velocity, {0, 1, -1}},
    FrictionConstant{"force", &Friction::force, {1, 0, 0}}};

/// A curved surface of this radius under a varying force: |N| ut / radius drives the body back; its constant part
/// nominal_force ut / radius is in K (contact/curved_surface.hpp).
struct CurvedSurface {
  double radius = 0.0, nominal_force = 0.0;
};

struct ContactSpec {
  std::string name = {};
  Law law = Law::compliant;
  std::optional<Direction> normal = {};   ///< compliant, rigid; node scenes: unit vector
  std::optional<Direction> tangent = {};  ///< node scenes with a normal: (ny, -nx)
  double gap = 0.0;
  double normal_stiffness = 0.0;
  std::optional<double> tangential_stiffness = {};
  double normal_damping = 0.0;      ///< dashpot parallel to the normal spring, >= 0
  double tangential_damping = 0.0;  ///< dashpot parallel to the tangential spring, >= 0
  Friction friction = {};
  HistorySpec normal_force = HistorySpec::zero();      ///< slider: compression, positive
  HistorySpec surface_velocity = HistorySpec::zero();  ///< slip rate = t . v - surface_velocity
  double initial_shear = 0.0;
  double restitution = 0.0;  ///< rigid: Newton's coefficient of restitution, 0 to 1
  /// rigid: a contact with a slower rebound stays closed; absent: the limit follows from the tolerances
  std::optional<double> capture_velocity = {};
  SourcePlace place = {};
  /// Surface of a pendulum; the stiffness nominal_force / radius is one of the scene's springs.
  std::optional<CurvedSurface> pendulum_surface = {};
  std::string table = {};  ///< table of the contact: "contacts.first", "stops.guide"; empty: contacts.NAME
  bool of_stop = false;
  /// User law in place of the rows, guards and transitions of `compliant`: from law = "yielding", or made in code.
  std::shared_ptr<const UserContactLaw> user_law = {};
  /// ForceLayout::Counts; results do not depend on them.
  std::uint32_t unused_forces = 0, unused_guards = 0;

  /// Capabilities of the named law; a user law replaces a compliant one.
  [[nodiscard]] LawCapabilities capabilities() const { return capabilities_of(law); }
  [[nodiscard]] ContactLawPtr contact_law() const {
    return user_law ? ContactLawPtr(user_law) : ContactLawPtr(law);
  }
  /// The direction along which N acts; nullptr if the scene gives N as a history, or gives no direction.
  [[nodiscard]] const Direction* bearing_normal() const {
    return normal && !capabilities().normal_force_given ? &*normal : nullptr;
  }
  /// Key in messages: "contacts.first.gap", "stops.guide.direction".
  [[nodiscard]] std::string key(const std::string& of) const {
    return (table.empty() ? "contacts." + name : table) + "." +
           (of_stop && of == "normal" ? "direction" : of);
  }
};

/// Ground acceleration along a direction; displacements are relative to the base. The load is -M r a(t).
struct BaseMotionSpec {
  Direction direction;  ///< r: the same for all nodes (its node is empty), or by degree of freedom
  HistorySpec acceleration;
  SourcePlace place;
};

enum class LoadType { force, moment, distributed, traction };

/// A force or a moment at a node, a force per length on pieces of members, or a traction on a boundary of a body.
struct LoadSpec {
  Direction direction = {};  ///< moment: its node only
  double amplitude = 0.0;
  HistorySpec history = {};
  SourcePlace place = {};
  std::string name = {};  ///< name in results and stages; empty: "load NUMBER"
  LoadType type = LoadType::force;
  std::vector<std::string> pieces = {};  ///< distributed: nodes; consecutive ones span a piece of a member
  bool member_axes = false;  ///< distributed: direction in the axes of the piece (along, to the left)
  std::string group = {};    ///< traction: "BODY.GROUP"
  bool pressure = false;     ///< traction: against the outward normal instead of along a direction
};

/// Kind of an [[output]]; each has a row in all_output_kinds.
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
/// Quantity of an output. Members have N, V, M and stress; bodies xx, yy and xy; contacts N, T, gap, slip and loss.
enum class OutputQuantity : unsigned char { none, N, V, M, T, gap, slip, loss, stress, xx, yy, xy };
/// True for a component of the stress at a node of a body.
[[nodiscard]] constexpr bool is_of_body(OutputQuantity q) {
  return q == OutputQuantity::xx || q == OutputQuantity::yy || q == OutputQuantity::xy;
}
/// Extreme fibre of a section: left or right as seen along the course from node to node, or both.
enum class Fibre : unsigned char { both, left, right };

struct OutputKindName {
  OutputKind kind;
  const char* name;     ///< as in scene files
  const char* meaning;  ///< for the documentation
};
inline constexpr std::array all_output_kinds = {
    OutputKindName{OutputKind::displacement, "displacement", "of a node along a direction"},
    OutputKindName{OutputKind::velocity, "velocity", "of a node along a direction"},
    OutputKindName{OutputKind::acceleration, "acceleration",
                   "of a node along a direction, absolute: that of the base is added"},
    OutputKindName{OutputKind::relative, "relative",
                   "displacement of the first node less that of the second, along a direction"},
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
                   "force (or moment) in a spring, preload and the damper beside it included"},
    OutputKindName{OutputKind::contact, "contact", "N, T, gap, slip or loss of a contact"},
    OutputKindName{OutputKind::combination, "combination", "sum of other outputs times factors"},
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
  std::vector<std::string> at;  ///< nodes, or a contact; envelope: consecutive nodes span a piece
  Direction direction;    ///< unit vector, or degrees of freedom as given; stress of a body: the axis x of xx
  bool rotation = false;  ///< instead of a direction
  OutputQuantity quantity = OutputQuantity::none;
  double station = 0.0;           ///< member_force, stress: 0 at at[0], 1 at at[1]
  std::size_t spring = 0;         ///< index into Scene::springs
  std::vector<OutputTerm> terms;  ///< combination
  SourcePlace place;
  Fibre fibre = Fibre::both;                   ///< fibre of stresses
  std::optional<double> intensification = {};  ///< factor of bending stresses; absent: that of the bend, or 1
};

/// Triplets (row, column, value); symmetric matrices are stored in full.
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
  std::vector<SurfaceSpec> surfaces;       ///< only with matrices
  std::vector<SurfaceNode> surface_nodes;  ///< nodes of all surfaces, each once
  std::vector<SeamSpec> seams;             ///< without tied seams
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
  std::string resolved;  ///< the same scene as TOML with every default filled in (run.toml)
};

/// One `--set path=value`.
struct Override {
  std::string path, value;
  /// Text of the override in messages, as the user typed it; empty: --set path=value.
  std::string shown_as = {};
};

/// Reads, checks and completes a scene. Errors: SceneError (with place and key), FileError, UsageError for a wrong override.
[[nodiscard]] Scene read_scene(const std::string& path, const std::vector<Override>& overrides = {});
/// Reads, checks and completes a scene in memory. `file` names it in messages; matrix files are relative to its folder.
[[nodiscard]] Scene parse_scene(const std::string& text, const std::string& file,
                                const std::vector<Override>& overrides = {});

}  // namespace signorini
