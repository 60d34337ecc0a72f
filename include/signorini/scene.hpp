// scene.hpp: a scene as the file says it, with every default filled in and every unit checked.
//
//   M u'' + C u' + K u = P(t) - sum_k ( n_k N_k + t_k T_k )
//
// A Scene knows names, places and numbers, no matrices. docs/scene.md is its reference.
//
//   Scene scene = read_scene("models/pipeline.toml", {{"run.rtol", "1e-10"}});
#pragma once

#include <array>
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
#include "signorini/own_law.hpp"
#include "signorini/plane_mesh.hpp"

namespace signorini {

/// Names of units; checked: force = mass * length / time^2.
struct Units {
  std::string force, mass, length, time;
};

/// Of units of force, length and time: positive, finite.
struct Factors {
  double force = 1.0, length = 1.0, time = 1.0;
};

/// Of a quantity: force^a length^b time^c; all zero: a plain number.
struct Unit {
  int force = 0, length = 0, time = 0;
};

enum class HistoryType { constant, step, rectangle, triangle, half_sine, harmonic, polynomial, table };

/// f(t) = offset + amplitude * shape(t). A load's amplitude stands outside its history, so for loads
/// offset is 0 and amplitude 1 here.
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
  bool start_given = false;                     ///< without it a constant holds since ever
  bool hold = false;                            ///< table: the last value holds from the last time on
  double shift = 0.0;                           ///< all of it later by this
  double period = 0.0;                          ///< > 0: the shape begins anew every so long, `rounds` times
  int rounds = 1;
  SourcePlace place = {};
  /// Of scenes made in code: this history is the shape, whatever the type and its keys say.
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
  /// Nodes whose displacements, times their weights, are subtracted: what the node touches.
  std::vector<std::pair<std::string, double>> against = {};
};

/// newmark: how the time of an event is found. root: the step redone until the guard at its end is zero;
/// linear: redone once, to the interpolated time.
enum class Refine { root, linear };
/// newmark: doubling looks for the step at which doubling it changes the result by less than the tolerance.
enum class StepControl { fixed, doubling };
/// exact: what the motion between events is computed with.
enum class Flow { automatic, modal, taylor };
/// Whether a run is certified (certify.hpp); automatic: where that is cheap.
enum class Certify { automatic, yes, no };
/// What a run is certified by: the exact flow, or the same engine with a finer setting.
enum class Companion { automatic, exact, finer };

/// Absolute tolerances; where absent, rtol times a scale of the scene.
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
  std::optional<double> dt = {};      ///< newmark, friction-iteration: the step; doubling: the greatest one
  Refine refine = Refine::root;
  StepControl step = StepControl::fixed;
  Flow flow = Flow::automatic;
  Certify certify = Certify::automatic;
  Companion companion = Companion::automatic;
  /// ida, no key: flights are low by so many times the tolerance (of a finer companion: by that of its run).
  double flight_tolerances = 1.0;
  double relaxation = 1.0;   ///< friction-iteration: part of the change of a bound that is taken, in (0, 1]
  int max_iterations = 100;  ///< friction-iteration: a step, before the run stops
  bool geometric = false;    ///< static forces have a stiffness (FrozenForces)
  SourcePlace place = {};
  SourcePlace geometric_place = {};

  /// The grid of history.csv: strictly ascending, t_end last. Errors: more than 1e8 times.
  [[nodiscard]] std::vector<double> grid() const;
};

/// A step of a frictional start: these loads grow slowly from what they were to what they are at t = 0.
struct StageSpec {
  std::string name;
  std::vector<std::string> loads;  ///< as Model::loads calls them, or "temperature", "supports": all of these
  int steps = 1;                   ///< parts of the stage after which its state is told
  SourcePlace place;
  std::vector<SourcePlace> load_places = {};  ///< one a load
};

/// Static forces whose geometric stiffness acts in a run (run.geometric).
struct FrozenForces {
  /// Axial force of a finite element at two nodes of the mesh, tension positive.
  struct Element {
    std::string from, to;
    double at_from = 0.0, at_to = 0.0;
  };
  /// Of a rigid body, moment per rotation: sum of F . r over the forces on it.
  struct Body {
    std::string name;
    double stiffness = 0.0;
  };
  std::vector<Element> elements;
  std::vector<Body> bodies;
};

/// Where a run stood: everything that its motion goes on from.
struct SavedState {
  std::string run;  ///< directory
  std::vector<std::pair<std::string, double>>
      motions;  ///< by name: displacements, velocities (scene/saved_state.hpp)
  std::vector<std::pair<std::string, double>> shears;  ///< T of contacts by name
  std::vector<std::pair<std::string, int>> slips;      ///< -1, 0, 1: which way contacts slip, by name
  struct Own {
    std::string contact;
    std::size_t state = 0;  ///< of its law
    double memory = 0.0;    ///< p
  };
  std::vector<Own> own;  ///< contacts with laws of one's own
  double t = 0.0;        ///< of the state, in the run's time
  /// A row of the run's contacts.csv at t: where contacts are that the motion goes on from, whatever states.csv has.
  struct Left {
    std::string contact, state;
    std::optional<double> gap;
    double ut = 0.0, vt = 0.0, slip = 0.0, N = 0.0, T = 0.0;
  };
  std::vector<Left> left;  ///< empty: contacts.csv has no such rows
  /// Of the run, that tolerances and what counts as rest stay: displacement, rotation, velocity, angular
  /// velocity, force.
  std::optional<std::array<double, 5>> scales;
  std::optional<FrozenForces> frozen;                   ///< of the run, if it had run.geometric
  std::vector<std::pair<std::string, double>> carried;  ///< what K of the run has of pendulums, by name
  std::vector<std::string> differing;  ///< tables in which the run's scene has another structure
};

/// initial = "static" or "frictional", the state of a run, or a state: by degree of freedom in the order of
/// [matrices] dofs, or by node.
struct InitialSpec {
  bool is_static = false;
  bool is_frictional = false;
  std::vector<StageSpec> stages = {};  ///< frictional; empty: all static loads at once
  std::optional<SavedState> saved = {};
  std::vector<double> u = {}, v = {};  ///< matrices: one a degree of freedom; empty: zero
  struct Component {
    std::string node, component;  ///< component: ux uy rz vx vy wz
    double value = 0.0;
    SourcePlace place;
  };
  std::vector<Component> components = {};
  SourcePlace place = {};
};

/// C = alpha M + beta K. alpha_over_omega1: alpha = that times omega1. Ratios at two frequencies are
/// alpha and beta here.
struct DampingSpec {
  double alpha = 0.0;
  double beta = 0.0;
  std::optional<double> alpha_over_omega1;
  SourcePlace place;
};

/// A run with a cutoff that a tolerance tried.
struct CutoffTrial {
  double cutoff_omega = 0.0;  ///< rad per time
  int modes = 0;              ///< kept
  double missed = 0.0;        ///< relative, what the modes left out would have added (study/reduction)
  double moved = 0.0;         ///< relative, greatest difference of displacements from the next trial; 0: none
  double error = 0.0;         ///< moved, plus what the next trial may be off by; missed where there is none
};

/// Modes up to the cutoff are kept, of the others their static compliance (model/reduce/reduction.hpp).
struct ReductionSpec {
  double cutoff_omega = 0.0;        ///< rad per time; 0 while it is to be found
  std::optional<double> tolerance;  ///< relative; find_cutoff sets the cutoff
  std::vector<CutoffTrial> tried;   ///< the last one is in force
  SourcePlace place;
};

struct Section {
  std::string name;
  double EA = 0.0, EI = 0.0, mass_per_length = 0.0;  ///< EI 0: for bars only
  double area = 0.0, modulus = 0.0;                  ///< stresses are N / area, M / modulus; 0: not known
  double pipe_radius = 0.0, pipe_wall = 0.0;         ///< mean radius of a pipe; 0: it is none
};

struct Node {
  std::string name = {};
  double x = 0.0, y = 0.0;
  SourcePlace place = {};
  bool of_mesh = false;  ///< of a body's mesh, without a name in the scene: no column of history.csv
};

enum class MassKind { consistent, lumped };
enum class MemberType { beam, bar };

/// The pieces of a member are arcs.
struct Bend {
  double radius = 0.0;           ///< > 0: the course from node to node turns left
  double flexibility = 1.0;      ///< EI is divided by it
  double intensification = 1.0;  ///< of stresses of bending
};

/// A chain of pieces between named nodes; elements[i] beams on piece i, one bar a piece.
struct Member {
  std::vector<std::string> nodes = {};
  std::string section = {};
  std::vector<int> elements = {};
  MemberType type = MemberType::beam;
  MassKind mass = MassKind::consistent;
  SourcePlace place = {};
  std::vector<std::string> release = {};             ///< first or last node, or both: hinged there
  double thermal_expansion = 0.0;                    ///< strain per temperature
  HistorySpec temperature = HistorySpec::zero();     ///< above that of the undeformed state
  HistorySpec initial_strain = HistorySpec::zero();  ///< along the member, positive: too long
  std::optional<Bend> bend = {};                     ///< absent: straight pieces
};

/// A plane continuum. Its nodes stand among Scene::nodes, called NAME.NUMBER, or as a point of the body is called.
struct BodySpec {
  std::string name = {};
  PlaneMesh mesh = {};  ///< without nodes: indices are into Scene::nodes
  std::size_t first_node = 0, node_count = 0;
  double E = 0.0, nu = 0.0, density = 0.0, thickness = 1.0;
  bool strain = false;  ///< plane strain, else plane stress
  MassKind mass = MassKind::consistent;
  double thermal_expansion = 0.0;                 ///< strain per temperature
  HistorySpec temperature = HistorySpec::zero();  ///< above that of the undeformed state
  std::vector<int> massless = {};                 ///< nodes whose mass is on others (contact_mass = "none")
  SourcePlace place = {};
};

/// A boundary of what [matrices] assemble: places, and degrees of freedom by name; empty: held.
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

/// A node of a seam: one of Scene::contacts each, in the same order.
struct SeamNode {
  int node = 0;                            ///< index into Scene::nodes, or Scene::surface_nodes
  std::array<double, 2> at{0.0, 0.0};      ///< its place
  double length = 0.0;                     ///< of the arc that belongs to it
  std::array<double, 2> normal{0.0, 0.0};  ///< in which it opens; the tangent is (ny, -nx)
};
/// Surfaces of bodies against each other, or against the ground: contacts NAME.1, NAME.2, ... along the arc.
struct SeamSpec {
  std::string name = {};
  std::size_t first_contact = 0;
  std::vector<SeamNode> nodes = {};
  double thickness = 1.0;
  SourcePlace place = {};
};

/// A node that follows others, u = sum_l w_l u_l, along x and y: of a seam with law = "tied".
struct TieSpec {
  std::string seam = {};
  int node = 0;                                     ///< index into Scene::nodes
  std::vector<std::pair<int, double>> master = {};  ///< the same, and w_l
  SourcePlace place = {};
};

struct PointMass {
  std::string node = {};
  double mass = 0.0;
  double inertia = 0.0;  ///< rotational, only where a rotation exists or inertia > 0
  SourcePlace place = {};
  std::string key = {};  ///< in messages, "rigid.block"; empty: masses.NUMBER
};

/// Nodes that move as one with its centre, u = u_c + rz x (r - r_c); its mass is one of Scene::masses.
struct RigidBody {
  std::string name = {};
  std::string centre = {};              ///< a node
  std::vector<std::string> nodes = {};  ///< the others
  SourcePlace place = {};
};

/// Spring and damper along `direction` between node and `against` (ground when empty).
struct Spring {
  std::string node, against;
  std::array<double, 2> direction{1.0, 0.0};  ///< normalised by the reader
  double stiffness = 0.0, damping = 0.0;
  SourcePlace place = {};
  double rotation_stiffness = 0.0, rotation_damping = 0.0;  ///< moment per rad, and per rad per time
  double preload = 0.0;                                     ///< force where nothing has moved
  std::optional<double> hot_load = {};                      ///< of a spring hanger, as it was designed
};

struct Support {
  std::string node = {};
  bool ux = false, uy = false, rz = false;
  SourcePlace place = {};
  /// What the one held degree of freedom follows; absent: it rests.
  std::optional<HistorySpec> motion = {};
  bool motion_is_acceleration = false;  ///< its second derivative, from rest at zero
  std::string key = "supports";         ///< in messages, "supports.3": a table may hold many nodes
};

/// Coefficients of friction, of a scene and of its contacts.
struct Friction {
  double static_ = 0.0;  ///< |T| <= static |N| in stick
  double kinetic =
      0.0;  ///< |T| = kinetic |N| in slip; where friction rises: of fast slip, no less than static_
  /// f = kinetic + (static - kinetic) exp(-|p'| / stribeck_velocity) while slipping
  std::optional<double> stribeck_velocity = {};
  /// f = fast - (fast - slow) exp(-|p'| / velocity) while slipping; static_ is slow, kinetic is fast
  std::optional<double> velocity = {};
  /// f = heavy + (light - heavy) exp(-|N| / force), in stick and in slip; static_ is light, kinetic is heavy
  std::optional<double> force = {};

  [[nodiscard]] bool any() const { return static_ > 0.0; }
  /// It grows with the slip rate, from static_ on: no jump where slip begins.
  [[nodiscard]] bool rises() const { return velocity.has_value(); }
  /// It depends on the slip rate: what slips is not linear.
  [[nodiscard]] bool varies() const { return stribeck_velocity || velocity; }
  /// It depends on the normal force.
  [[nodiscard]] bool by_force() const { return force.has_value(); }
  /// Where slip begins it drops.
  [[nodiscard]] bool drops() const { return static_ > kinetic && !varies() && !by_force(); }
  /// Of the exponential; where friction varies.
  [[nodiscard]] double rate_of_change() const { return velocity ? *velocity : stribeck_velocity.value(); }
};

/// A constant of friction beside the two coefficients: its key below `friction`, and its unit.
struct FrictionConstant {
  std::string_view key;
  std::optional<double> Friction::*value;
  Unit unit;
};
inline constexpr std::array friction_constants = {
    FrictionConstant{"stribeck_velocity", &Friction::stribeck_velocity, {0, 1, -1}},
    FrictionConstant{"velocity", &Friction::velocity, {0, 1, -1}},
    FrictionConstant{"force", &Friction::force, {1, 0, 0}}};

/// A surface of this radius under a force that varies: |N| ut / radius drives the body back, of which
/// carried ut / radius stands in K (contact/bowl.hpp).
struct Bowl {
  double radius = 0.0, carried = 0.0;
};

struct ContactSpec {
  std::string name = {};
  Law law = Law::compliant;
  std::optional<Direction> normal = {};   ///< compliant, rigid; node scenes: unit vector
  std::optional<Direction> tangent = {};  ///< node scenes with a normal: (ny, -nx)
  double gap = 0.0;
  double normal_stiffness = 0.0;
  std::optional<double> tangential_stiffness = {};
  double normal_damping = 0.0;      ///< dashpot beside the normal spring, >= 0
  double tangential_damping = 0.0;  ///< dashpot beside the tangential spring, >= 0
  Friction friction = {};
  HistorySpec normal_force = HistorySpec::zero();      ///< slider: compression, positive
  HistorySpec surface_velocity = HistorySpec::zero();  ///< slip rate = t . v - surface_velocity
  double initial_shear = 0.0;
  double restitution = 0.0;                     ///< rigid: Newton's coefficient, 0 to 1
  std::optional<double> capture_velocity = {};  ///< rigid: slower rebounds rest; absent: from the tolerances
  SourcePlace place = {};
  std::optional<Bowl> bowl = {};  ///< of a pendulum; `carried` stands among the springs
  std::string table = {};         ///< where it stands, "contacts.first", "stops.guide"; empty: contacts.NAME
  bool of_stop = false;
  /// Rows, guards and transitions in place of those of `compliant`: of law = "yielding", or made in code.
  std::shared_ptr<const OwnLaw> own = {};

  /// Of the law that is named; a law made of data stands in place of a compliant one.
  [[nodiscard]] LawCapabilities capabilities() const { return capabilities_of(law); }
  [[nodiscard]] ContactLawPtr contact_law() const { return own ? ContactLawPtr(own) : ContactLawPtr(law); }
  /// The direction along which N acts; nullptr where the scene gives N, or no direction.
  [[nodiscard]] const Direction* bearing_normal() const {
    return normal && !capabilities().normal_force_given ? &*normal : nullptr;
  }
  /// In messages: "contacts.first.gap", "stops.guide.direction".
  [[nodiscard]] std::string key(const std::string& of) const {
    return (table.empty() ? "contacts." + name : table) + "." +
           (of_stop && of == "normal" ? "direction" : of);
  }
};

/// Ground acceleration along a direction; displacements are relative to the base. The load is -M r a(t).
struct BaseMotionSpec {
  Direction direction;  ///< r: of all nodes alike (its node is empty), or by degree of freedom
  HistorySpec acceleration;
  SourcePlace place;
};

enum class LoadType { force, moment, distributed, traction };

/// A force or a moment at a node, a force per length on pieces of members, or a force per area on a boundary of a body.
struct LoadSpec {
  Direction direction = {};  ///< moment: its node only
  double amplitude = 0.0;
  HistorySpec history = {};
  SourcePlace place = {};
  std::string name = {};  ///< in results and stages; empty: "load 1", by its number
  LoadType type = LoadType::force;
  std::vector<std::string> pieces = {};  ///< distributed: nodes; from each to the next a piece of a member
  bool member_axes = false;              ///< distributed: direction is (along, to the left) of the piece
  std::string group = {};                ///< traction: "BODY.GROUP"
  bool pressure = false;  ///< traction: against the outward normal instead of along a direction
};

/// What an [[output]] is; a row of all_output_kinds each.
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
/// Of a member N, V, M, stress; of a body xx, yy, xy; of a contact the others, and N.
enum class OutputQuantity : unsigned char { none, N, V, M, T, gap, slip, loss, stress, xx, yy, xy };
/// A component of the stress at a node of a body.
[[nodiscard]] constexpr bool is_of_body(OutputQuantity q) {
  return q == OutputQuantity::xx || q == OutputQuantity::yy || q == OutputQuantity::xy;
}
/// Of a section: where y is greatest to the left of the course from node to node, to the right, or both.
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

/// A part of a combination.
struct OutputTerm {
  std::string name;  ///< of an output that stands before it
  double factor = 1.0;
  Unit unit = {};  ///< of the factor
};

/// A response quantity: a column of response.csv.
struct OutputSpec {
  std::string name;
  OutputKind kind = OutputKind::displacement;
  std::vector<std::string> at;  ///< nodes, or a contact; envelope: from each node to the next a piece
  Direction direction;    ///< unit vector, or degrees of freedom as given; stress of a body: the axis x of xx
  bool rotation = false;  ///< instead of a direction
  OutputQuantity quantity = OutputQuantity::none;
  double station = 0.0;           ///< member_force, stress: from at[0], 0, to at[1], 1
  std::size_t spring = 0;         ///< index into Scene::springs
  std::vector<OutputTerm> terms;  ///< combination
  SourcePlace place;
  Fibre fibre = Fibre::both;                   ///< of stresses
  std::optional<double> intensification = {};  ///< of stresses of bending; absent: that of the bend, or 1
};

/// Triplets (row, column, value), symmetric ones written out in full.
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
  std::vector<SurfaceSpec> surfaces;       ///< with matrices
  std::vector<SurfaceNode> surface_nodes;  ///< of all of them, each once
  std::vector<SeamSpec> seams;             ///< but for tied ones
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
  std::string told = {};  ///< what messages call it, as the user said it; empty: --set path=value
};

/// Reads, checks and completes a scene. Errors: SceneError (with place and key), FileError,
/// UsageError for a wrong override.
[[nodiscard]] Scene read_scene(const std::string& path, const std::vector<Override>& overrides = {});
/// The same from text; `file` is used in messages and to find matrix files beside it.
[[nodiscard]] Scene parse_scene(const std::string& text, const std::string& file,
                                const std::vector<Override>& overrides = {});

}  // namespace signorini
