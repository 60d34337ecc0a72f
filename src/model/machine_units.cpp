#include "model/machine_units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/components.hpp"

namespace signorini {
namespace {

// Limit of the exponents: products of four units then stay in the range of a double (mass = force time^2 / length).
constexpr int farthest = 120;

// For scenes without stiffness: the unit of time is a quarter of the run, 2^-2, the likely duration of one motion.
// Scales of displacement follow from it (a time^2). Chosen value; changing it changes the tests of
// validation/published.
constexpr int motions = 2;

/// Largest of several magnitudes, and its exponent: x = 2^e (1 to 2).
class Greatest {
 public:
  void add(double x) {
    if (std::isfinite(x)) most_ = std::max(most_, std::abs(x));
  }
  void add(const std::optional<double>& x) {
    if (x) add(*x);
  }
  [[nodiscard]] bool any() const { return most_ > 0.0; }
  [[nodiscard]] int exponent() const { return std::ilogb(most_); }

 private:
  double most_ = 0.0;
};

/// Larger extent along an axis.
Greatest extent_of(const std::vector<Node>& nodes) {
  Greatest extent;
  if (nodes.empty()) return extent;
  const auto [left, right] =
      std::minmax_element(nodes.begin(), nodes.end(), [](const Node& a, const Node& b) { return a.x < b.x; });
  const auto [low, high] =
      std::minmax_element(nodes.begin(), nodes.end(), [](const Node& a, const Node& b) { return a.y < b.y; });
  extent.add(right->x - left->x);
  extent.add(high->y - low->y);
  return extent;
}

struct Sizes {
  Greatest mass, stiffness, gap, displacement, velocity, acceleration, force;
};

void add_matrices(const MatricesSpec& matrices, Sizes& sizes) {
  for (const MatrixSpec::Entry& e : matrices.mass.entries) sizes.mass.add(e.value);
  for (const MatrixSpec::Entry& e : matrices.stiffness.entries) sizes.stiffness.add(e.value);
}

void add_initial(const InitialSpec& initial, Sizes& sizes) {
  for (const InitialSpec::Component& c : initial.components) {
    const auto named = component_named(c.component);
    if (named && !named->component().rotation)
      (named->rate ? sizes.velocity : sizes.displacement).add(c.value);
  }
}

/// `length`: exponent of the extent, if there are members.
Sizes sizes_of(const Scene& scene, int length) {
  Sizes sizes;
  if (scene.matrices) add_matrices(*scene.matrices, sizes);
  for (const Section& s : scene.sections) {
    sizes.stiffness.add(std::ldexp(s.EA, -length));
    sizes.mass.add(std::ldexp(s.mass_per_length, length));
  }
  for (const BodySpec& b : scene.bodies) {  // treated as a square of the extent
    sizes.stiffness.add(b.E * b.thickness);
    sizes.mass.add(std::ldexp(b.density * b.thickness, 2 * length));
  }
  for (const PointMass& m : scene.masses) sizes.mass.add(m.mass);
  for (const Spring& s : scene.springs) sizes.stiffness.add(s.stiffness);
  for (const ContactSpec& c : scene.contacts) {
    sizes.stiffness.add(c.normal_stiffness);
    sizes.stiffness.add(c.tangential_stiffness);
    sizes.gap.add(c.gap);
    sizes.velocity.add(c.surface_velocity.offset);
    sizes.velocity.add(c.surface_velocity.amplitude);
    sizes.force.add(c.normal_force.offset);
    sizes.force.add(c.normal_force.amplitude);
  }
  for (const LoadSpec& load : scene.loads)
    if (load.type == LoadType::force) sizes.force.add(load.amplitude);
  for (const double g : scene.gravity) sizes.acceleration.add(g);
  for (const BaseMotionSpec& motion : scene.base_motion) {
    sizes.acceleration.add(motion.acceleration.offset);
    sizes.acceleration.add(motion.acceleration.amplitude);
  }
  add_initial(scene.initial, sizes);
  return sizes;
}

/// Exponent of length for scenes without an extended structure; 0 if the scene has no lengths.
int length_of_motion(const Sizes& sizes, int time, int mass) {
  if (sizes.gap.any()) return sizes.gap.exponent();
  if (sizes.displacement.any()) return sizes.displacement.exponent();
  if (sizes.velocity.any()) return sizes.velocity.exponent() + time;
  if (sizes.acceleration.any()) return sizes.acceleration.exponent() + 2 * time;
  if (sizes.force.any()) return sizes.force.exponent() + 2 * time - mass;
  return 0;
}

int half(int exponent) { return exponent >> 1; }  // rounds down, also for negative exponents

}  // namespace

Factors machine_units(const Scene& scene) {
  const Greatest extent = extent_of(scene.nodes);
  const Sizes sizes = sizes_of(scene, extent.any() ? extent.exponent() : 0);
  Greatest run;
  run.add(scene.run.t_end);
  if (!sizes.mass.any() || !run.any()) return {};
  const int mass = sizes.mass.exponent();
  const int time = sizes.stiffness.any() ? half(mass - sizes.stiffness.exponent()) : run.exponent() - motions;
  const int length = scene.matrices ? 0
                     : extent.any() ? extent.exponent()
                                    : length_of_motion(sizes, time, mass);
  const int force = mass + length - 2 * time;
  if (std::max({std::abs(force), std::abs(length), std::abs(time)}) > farthest) return {};
  return {std::ldexp(1.0, force), std::ldexp(1.0, length), std::ldexp(1.0, time)};
}

}  // namespace signorini
