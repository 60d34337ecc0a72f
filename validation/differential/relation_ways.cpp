// Relations of space and of units: the same problem, written in another way.
#include <fmt/core.h>

#include <algorithm>

#include "differential/random.hpp"
#include "differential/relation.hpp"
#include "differential/transform.hpp"

namespace signorini::differential {
namespace {

Related related(Transformed other) {
  Related result{std::move(other.name), std::move(other.scene), other.factors};
  result.mirrored = other.mirrored;
  return result;
}

std::optional<Related> related(std::optional<Transformed> other) {
  if (!other) return std::nullopt;
  return related(std::move(*other));
}

/// A mass on a spring, hit by a load: in the scene's units, far from everything.
void add_body(Scene& scene, Random& draw) {
  const double mass = draw.real(0.5, 50.0), period = scene.run.t_end * draw.real(0.1, 0.6);
  Node node;
  node.name = "beside_body";
  double far = 1.0;
  for (const Node& other : scene.nodes) far = std::max({far, std::abs(other.x), std::abs(other.y)});
  node.x = 3.0 * far;
  node.y = 2.0 * far;
  scene.nodes.push_back(node);
  PointMass point;
  point.node = node.name;
  point.mass = mass;
  scene.masses.push_back(point);
  Spring spring;
  spring.node = node.name;
  spring.stiffness = mass * 40.0 / (period * period);
  scene.springs.push_back(spring);
  spring.direction = {0.0, 1.0};
  scene.springs.push_back(spring);
  LoadSpec load;
  load.name = "beside_load";
  load.direction.node = node.name;
  load.direction.vector = {1.0, 0.0};
  load.amplitude = 5.0 * mass;
  load.history.type = HistoryType::step;
  load.history.start = scene.run.t_end * draw.real(0.1, 0.9);
  scene.loads.push_back(load);
}

bool names_its_tolerances(const Scene& scene) {
  const Tolerances& atol = scene.run.atol;
  return atol.displacement && atol.velocity && atol.force &&
         std::all_of(scene.contacts.begin(), scene.contacts.end(), [](const ContactSpec& contact) {
           return !contact.capabilities().takes_impulses || contact.capture_velocity.has_value();
         });
}

}  // namespace

std::optional<Related> related_turned(const Scene& scene, std::uint64_t seed) {
  Random draw(seed);
  const double degrees = draw.real(-180.0, 180.0);
  std::optional<Transformed> any = turned(scene, degrees);
  return related(any ? std::move(any) : turned(scene, 90.0 * draw.integer(1, 3)));
}

std::optional<Related> related_mirrored(const Scene& scene, std::uint64_t /*seed*/) {
  // A pad that is crushed is called slip- whichever way it lies.
  for (const ContactSpec& contact : scene.contacts)
    if (contact.user_law) return std::nullopt;
  std::optional<Related> result = related(mirrored(scene));
  if (!result) return result;
  for (OutputSpec& output : result->scene.outputs) {
    const double sign = mirror_sign(scene, output);
    result->output_factors[output.name] = sign;
    if (output.kind == OutputKind::envelope &&
        (output.quantity == OutputQuantity::M || output.quantity == OutputQuantity::V))
      result->extreme_signs[output.name] = -1.0;
    for (OutputTerm& part : output.terms)
      for (const OutputSpec& term : scene.outputs)
        if (term.name == part.name) part.factor *= sign * mirror_sign(scene, term);
  }
  return result;
}

std::optional<Related> related_permuted(const Scene& scene, std::uint64_t seed) {
  return related(permuted(scene, seed));
}

std::optional<Related> related_reversed(const Scene& scene, std::uint64_t /*seed*/) {
  return related(reversed(scene));
}

std::optional<Related> related_in_units(const Scene& scene, std::uint64_t seed) {
  if (!names_its_tolerances(scene)) return std::nullopt;
  Random draw(seed);
  Scene with_body = scene;
  const bool beside = !scene.matrices && !scene.reduction && draw.chance(0.7);
  if (beside) add_body(with_body, draw);
  const double force = draw.one_of({1e-6, 1e-3, 1.0, 1e3}), time = draw.one_of({1.0, 1e3});
  const double length = scene.matrices ? 1.0 : draw.one_of({1.0, 100.0, 1000.0});
  std::optional<Related> result = related(in_units(with_body, {force, length, time}));
  if (result && beside) {
    result->same_energy = result->same_steps = false;
    result->name += ", a body beside";
  }
  return result;
}

}  // namespace signorini::differential
