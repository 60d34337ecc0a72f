#include "differential/transform.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "differential/random.hpp"

namespace signorini::differential {
namespace {

/// A linear map of the plane, without a change of lengths.
struct Map {
  double xx = 1.0, xy = 0.0, yx = 0.0, yy = 1.0;
  double turn = 1.0;  ///< of rotations: its determinant

  [[nodiscard]] std::array<double, 2> operator()(double x, double y) const {
    return {xx * x + xy * y, yx * x + yy * y};
  }
  void apply(std::array<double, 2>& v) const { v = (*this)(v[0], v[1]); }
};

/// Components of one node belong together: ux with uy, vx with vy.
void move_initial(InitialSpec& initial, const Map& map) {
  std::map<std::string, std::map<std::string, InitialSpec::Component>> nodes;
  for (const InitialSpec::Component& c : initial.components) nodes[c.node][c.component] = c;
  initial.components.clear();
  for (auto& [node, parts] : nodes) {
    for (const char* turning : {"rz", "wz"})
      if (const auto it = parts.find(turning); it != parts.end()) {
        it->second.value *= map.turn;
        initial.components.push_back(it->second);
      }
    for (const char* kind : {"u", "v"}) {
      const auto value = [kind, &components = parts](const char* axis) {  // clang 14 captures no binding
        const auto it = components.find(std::string(kind) + axis);
        return it == components.end() ? 0.0 : it->second.value;
      };
      const std::array<double, 2> moved = map(value("x"), value("y"));
      for (std::size_t i = 0; i < 2; ++i)
        if (moved[i] != 0.0)
          initial.components.push_back({node, std::string(kind) + (i == 0 ? "x" : "y"), moved[i], {}});
    }
  }
}

void move(Scene& scene, const Map& map) {
  map.apply(scene.gravity);
  for (Node& node : scene.nodes) {
    const std::array<double, 2> place = map(node.x, node.y);
    node.x = place[0];
    node.y = place[1];
  }
  for (SeamSpec& seam : scene.seams)
    for (SeamNode& node : seam.nodes) {
      map.apply(node.at);
      map.apply(node.normal);
    }
  for (Spring& spring : scene.springs) map.apply(spring.direction);
  for (Member& member : scene.members)
    if (member.bend) member.bend->radius *= map.turn;
  for (ContactSpec& contact : scene.contacts) {
    if (contact.normal) map.apply(contact.normal->vector);
    if (contact.tangent) map.apply(contact.tangent->vector);
  }
  for (LoadSpec& load : scene.loads) {
    if (load.type == LoadType::moment)
      load.amplitude *= map.turn;
    else if (load.member_axes)
      load.direction.vector[1] *= map.turn;  // to the left of the member
    else
      map.apply(load.direction.vector);
  }
  for (BaseMotionSpec& motion : scene.base_motion) map.apply(motion.direction.vector);
  for (OutputSpec& output : scene.outputs) {
    map.apply(output.direction.vector);
    if (map.turn < 0.0 && output.fibre != Fibre::both)
      output.fibre = output.fibre == Fibre::left ? Fibre::right : Fibre::left;
  }
  for (Support& support : scene.supports) {
    if (!support.motion) continue;
    const std::array<double, 2> along = map(support.ux ? 1.0 : 0.0, support.uy ? 1.0 : 0.0);
    const double sign = support.rz ? map.turn : along[0] + along[1];  // quarter turns and mirrors only
    support.motion->offset *= sign;
    support.motion->amplitude *= sign;
  }
  move_initial(scene.initial, map);
}

template <class T>
void shuffle(std::vector<T>& list, Random& draw) {
  for (std::size_t i = list.size(); i > 1; --i)
    std::swap(list[i - 1], list[static_cast<std::size_t>(draw.integer(0, static_cast<int>(i) - 1))]);
}

/// Outputs name springs by their place.
void shuffle_springs(Scene& scene, Random& draw) {
  std::vector<std::size_t> places(scene.springs.size());
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = i;
  shuffle(places, draw);
  std::vector<Spring> springs;
  for (const std::size_t place : places) springs.push_back(scene.springs[place]);
  scene.springs = std::move(springs);
  for (OutputSpec& output : scene.outputs)
    if (output.kind == OutputKind::spring)
      output.spring =
          static_cast<std::size_t>(std::find(places.begin(), places.end(), output.spring) - places.begin());
}

/// True if a stop touches at the start without a force: its reaction is zero up to rounding, of either sign. Not for a
/// scene that is refused.
bool touches_without_force(const Scene& scene) {
  if (!scene.initial.is_static) return false;
  const Model model = build_model(scene);
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& contact = model.contacts[k];
    const double size = std::abs(contact.gap) + contact.normal.magnitude(model.u0);
    const bool touches = !contact.normal_force_given() && std::abs(contact.gap_at(model.u0)) <= 1e-12 * size;
    if (touches && contact.gap != 0.0 && model.statics.reactions[k] <= 1e-9 * model.scales.force) return true;
  }
  return false;
}

double size_of(const Scene& scene) {
  double size = 0.0;
  for (const Node& node : scene.nodes) size = std::max({size, std::abs(node.x), std::abs(node.y)});
  return size;
}

State mirror_image(State state) {
  if (state == State::slip_plus) return State::slip_minus;
  return state == State::slip_minus ? State::slip_plus : state;
}

std::string mirror_image(const std::string& state) {
  return state == "slip+" ? "slip-" : state == "slip-" ? "slip+" : state;
}

/// Symmetric entries alike.
void disturb(MatrixSpec& matrix, Random& draw) {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  std::map<std::pair<int, int>, double> factors;
  for (MatrixSpec::Entry& e : matrix.entries) {
    const auto [it, first] = factors.try_emplace(std::minmax(e.row, e.column), 1.0);
    if (first) it->second += eps * draw.real(-1.0, 1.0);
    e.value *= it->second;
  }
}

}  // namespace

std::optional<Transformed> turned(const Scene& scene, double degrees) {
  if (scene.matrices) return std::nullopt;
  const double quarters = degrees / 90.0;
  const bool quarter = quarters == std::round(quarters);
  if (!quarter)
    for (const Support& support : scene.supports)
      if (support.ux != support.uy) return std::nullopt;
  Transformed result{fmt::format("turned by {:.10g} degrees", degrees), scene, {}};
  const double angle = degrees * std::numbers::pi / 180.0;
  double c = std::cos(angle), s = std::sin(angle);
  if (quarter) {  // exactly
    c = std::round(c);
    s = std::round(s);
  }
  move(result.scene, {c, -s, s, c, 1.0});
  if (quarter && s != 0.0)
    for (Support& support : result.scene.supports) std::swap(support.ux, support.uy);
  return result;
}

std::optional<Transformed> mirrored(const Scene& scene) {
  if (scene.matrices || !scene.bodies.empty()) return std::nullopt;
  Transformed result{"mirrored", scene, {}, true};
  move(result.scene, {-1.0, 0.0, 0.0, 1.0, -1.0});
  for (ContactSpec& contact : result.scene.contacts) {
    if (contact.tangent)
      for (double& t : contact.tangent->vector) t = -t;
    contact.surface_velocity.offset = -contact.surface_velocity.offset;
    contact.surface_velocity.amplitude = -contact.surface_velocity.amplitude;
    contact.initial_shear = -contact.initial_shear;
  }
  return result;
}

Transformed permuted(const Scene& scene, std::uint64_t seed) {
  Transformed result{fmt::format("permuted by seed {}", seed), scene, {}};
  Random draw(seed);
  if (scene.bodies.empty()) shuffle(result.scene.nodes, draw);  // meshes name nodes by their place
  shuffle(result.scene.members, draw);
  shuffle(result.scene.masses, draw);
  shuffle_springs(result.scene, draw);
  shuffle(result.scene.supports, draw);
  // Seams name contacts by their place.
  if (scene.seams.empty() && !touches_without_force(scene)) shuffle(result.scene.contacts, draw);
  shuffle(result.scene.loads, draw);
  return result;
}

std::optional<Transformed> reversed(const Scene& scene) {
  if (scene.members.empty()) return std::nullopt;
  Transformed result{"reversed", scene, {}};
  for (Member& member : result.scene.members) {
    std::reverse(member.nodes.begin(), member.nodes.end());
    std::reverse(member.elements.begin(), member.elements.end());
    if (member.bend) member.bend->radius *= -1.0;
  }
  return result;
}

std::optional<Transformed> in_units(const Scene& scene, const Factors& factors) {
  if (scene.matrices && factors.length != 1.0) return std::nullopt;
  return Transformed{
      fmt::format("forces x {:g}, lengths x {:g}, times x {:g}", factors.force, factors.length, factors.time),
      scene::rescaled(scene, factors), factors};
}

Scene disturbed(const Scene& scene, std::uint64_t seed) {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  Scene result = scene;
  Random draw(seed);
  const auto relative = [&] { return 1.0 + eps * draw.real(-1.0, 1.0); };
  scene::visit_quantities(result, [&](double& x, const Unit&) { x *= relative(); });
  result.run = scene.run;
  if (scene.matrices) {
    result.matrices = scene.matrices;
    for (MatrixSpec* matrix :
         {&result.matrices->mass, &result.matrices->damping, &result.matrices->stiffness})
      disturb(*matrix, draw);
  }
  const double size = size_of(scene);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    result.nodes[i].x = scene.nodes[i].x + eps * size * draw.real(-1.0, 1.0);
    result.nodes[i].y = scene.nodes[i].y + eps * size * draw.real(-1.0, 1.0);
  }
  const auto bend = [&](std::array<double, 2>& v) {
    const double length = std::hypot(v[0], v[1]);
    for (double& x : v) x += eps * length * draw.real(-1.0, 1.0);
  };
  for (ContactSpec& contact : result.contacts) {
    const double friction = relative();
    contact.friction.static_ *= friction;
    contact.friction.kinetic *= friction;
    contact.restitution = std::min(1.0, contact.restitution * relative());
    if (!scene.matrices && contact.normal) bend(contact.normal->vector);
    if (!scene.matrices && contact.tangent) bend(contact.tangent->vector);
  }
  for (LoadSpec& load : result.loads)
    if (!scene.matrices) bend(load.direction.vector);
  return result;
}

Track mapped_back(Track track, const Transformed& from, const Track& reference, const Scene& scene) {
  track.t /= from.factors.time;
  for (compare::LoggedEvent& event : track.events) {
    event.t /= from.factors.time;
    event.uncertainty /= from.factors.time;
    if (!from.mirrored) continue;
    event.from = mirror_image(event.from);
    event.to = mirror_image(event.to);
  }
  std::vector<std::size_t> place;  // of the scene's contacts in the transformed one
  for (const ContactSpec& contact : scene.contacts) {
    const auto& others = from.scene.contacts;
    const auto it = std::find_if(others.begin(), others.end(),
                                 [&](const ContactSpec& other) { return other.name == contact.name; });
    place.push_back(static_cast<std::size_t>(it - others.begin()));
  }
  for (std::size_t i = 0; i < track.rows.size(); ++i) {
    Result::Row& row = track.rows[i];
    row.t = i < reference.rows.size() ? reference.rows[i].t : row.t / from.factors.time;
    std::vector<ContactSample> contacts;
    for (const std::size_t k : place) {
      ContactSample sample = row.contacts[k];
      sample.N /= from.factors.force;
      sample.T /= from.mirrored ? -from.factors.force : from.factors.force;
      if (from.mirrored) sample.state = mirror_image(sample.state);
      contacts.push_back(sample);
    }
    row.contacts = std::move(contacts);
  }
  return track;
}

}  // namespace signorini::differential
