#include "model/internal_units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/constants.hpp"
#include "scene/components.hpp"

namespace signorini::model {
namespace {

// Limit of the exponents: products of four units (mass = force time^2 / length) then stay in the range of a double.
constexpr int max_exponent = 120;

// Exponent of the unit of time of scenes without stiffness: 2^-2 of the run, the likely duration of one motion. Scales of
// displacement follow from this unit (acceleration time^2). Chosen value; changing it changes the tests of
// validation/published.
constexpr int time_unit_exponent = -2;

/// Largest of several magnitudes x, and its exponent e: 2^e <= x < 2^(e + 1).
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

/// Larger one of the structure's extents along x and y.
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
    const auto named = scene::component_named(c.component);
    if (named && !named->component().rotation)
      (named->rate ? sizes.velocity : sizes.displacement).add(c.value);
  }
}

/// Largest magnitude of each quantity in the scene. length: exponent of the extent; 0 without nodes.
Sizes sizes_of(const Scene& scene, int length) {
  Sizes sizes;
  if (scene.matrices) add_matrices(*scene.matrices, sizes);
  for (const Section& s : scene.sections) {
    sizes.stiffness.add(std::ldexp(s.EA, -length));
    sizes.mass.add(std::ldexp(s.mass_per_length, length));
  }
  for (const BodySpec& b : scene.bodies) {  // a body is treated as a square with this extent
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

/// Exponent of the unit of length for scenes whose nodes have no extent; 0 if the scene has no lengths.
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

Factors find_internal_units(const Scene& scene) {
  const Greatest extent = extent_of(scene.nodes);
  const Sizes sizes = sizes_of(scene, extent.any() ? extent.exponent() : 0);
  Greatest run;
  run.add(scene.run.t_end);
  if (!sizes.mass.any() || !run.any()) return {};
  const int mass = sizes.mass.exponent();
  const int time =
      sizes.stiffness.any() ? half(mass - sizes.stiffness.exponent()) : run.exponent() + time_unit_exponent;
  const int length = scene.matrices ? 0
                     : extent.any() ? extent.exponent()
                                    : length_of_motion(sizes, time, mass);
  const int force = mass + length - 2 * time;
  if (std::max({std::abs(force), std::abs(length), std::abs(time)}) > max_exponent) return {};
  return {std::ldexp(1.0, force), std::ldexp(1.0, length), std::ldexp(1.0, time)};
}

namespace {

class Rescaling {
 public:
  Rescaling(const Factors& factors, const std::vector<Dof>& dofs) : factors_(factors), dofs_(dofs) {}

  void operator()(double& x, const Unit& of) const { x *= scene::factor_of(of, factors_); }
  void operator()(std::optional<double>& x, const Unit& of) const {
    if (x) (*this)(*x, of);
  }

  /// Conversion factor of displacement i: the factor of a length, or 1 for a rotation.
  [[nodiscard]] double of_dof(int i) const {
    return dofs_[static_cast<std::size_t>(i)].rotation ? 1.0 : factors_.length;
  }
  void operator()(Vector& x, const Unit& over_displacement) const {
    const double factor = scene::factor_of(over_displacement, factors_);
    for (int i = 0; i < x.size(); ++i) x[i] *= of_dof(i) * factor;
  }
  /// Scales a matrix A whose value u^T A u has the unit energy * `more`.
  void operator()(SparseMatrix& a, const Unit& more) const {
    const double factor = scene::factor_of(unit::energy, factors_) * scene::factor_of(more, factors_);
    for (int j = 0; j < a.outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(a, j); it; ++it)
        it.valueRef() *= factor / (of_dof(static_cast<int>(it.row())) * of_dof(j));
  }
  /// Scales a form n whose value n . u has the unit length * `more`; n is also the direction of a force.
  void operator()(Combination& form, const Unit& more = unit::plain) const {
    const double length = scene::factor_of(more, factors_) * factors_.length;
    for (auto& [i, factor] : form.terms) factor *= length / of_dof(i);
  }
  void operator()(History& history, const Unit& of) const {
    scene::visit_numbers(history, of, [this](double& x, const Unit& unit) { (*this)(x, unit); });
  }

  /// Scales a matrix that maps displacements to displacements.
  void basis(SparseMatrix& b) const {
    for (int j = 0; j < b.outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(b, j); it; ++it)
        it.valueRef() *= of_dof(static_cast<int>(it.row())) / of_dof(j);
  }

  /// Scales ties; *this must have been constructed with Ties::dofs.
  void operator()(Ties& ties) const {
    const auto first = static_cast<int>(ties.rows.cols());
    for (int j = 0; j < ties.rows.outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(ties.rows, j); it; ++it)
        it.valueRef() *= of_dof(first + static_cast<int>(it.row())) / of_dof(j);
    for (Ties::Given& given : ties.given)
      (*this)(given.motion,
              dofs_[static_cast<std::size_t>(first + given.tied)].rotation ? unit::plain : unit::length);
  }

  void operator()(Load& load) const {
    (*this)(load.direction, load.direction_unit);
    (*this)(load.history, load.history_unit);
  }

  /// Scales a form n whose value n . u has the unit `of`.
  void value_of(Combination& form, const Unit& of) const {
    const double value = scene::factor_of(of, factors_);
    for (auto& [i, factor] : form.terms) factor *= value / of_dof(i);
  }
  void operator()(Output& o) const {
    if (is_envelope(o)) return for_each_linear(o, [this](Output& linear) { (*this)(linear); });
    const Unit& of = o.unit;
    value_of(o.u, of);
    value_of(o.v, {of.force, of.length, of.time + 1});
    value_of(o.a, {of.force, of.length, of.time + 2});
    for (Output::ContactForces& f : o.forces)
      for (double* x : {&f.N, &f.T}) (*this)(*x, {of.force - 1, of.length, of.time});
    for (Output::Restoring& r : o.restoring) {
      (*this)(r.slip);
      (*this)(r.factor, {of.force - 1, of.length - 1, of.time});
      (*this)(r.scene_force, unit::force);
    }
    for (Output::Given& given : o.given) {
      (*this)(given.history, of);
      given.factor *= scene::factor_of(of, factors_) / scene::factor_of(given.load_unit, factors_);
    }
    (*this)(o.constant, of);
  }

  void operator()(Contact& c) const {
    contact::visit_forms(c, [this](Combination& form) { (*this)(form); });
    contact::visit_constants(c, [this](double& x, const Unit& of) { (*this)(x, of); });
    (*this)(c.normal_force, unit::force);
    (*this)(c.surface_motion, unit::length);
  }

  void operator()(Prestress& forces) const {
    for (Prestress::Element& e : forces.elements)
      for (double* n : {&e.at_from, &e.at_to}) (*this)(*n, unit::force);
    for (Prestress::Body& body : forces.bodies) (*this)(body.stiffness, unit::energy);
  }

  void operator()(Scales& s) const {
    (*this)(s.displacement, unit::length);
    (*this)(s.velocity, unit::velocity);
    (*this)(s.angular_velocity, unit::rate);
    (*this)(s.force, unit::force);
  }

  /// Scales a reduction; *this must have been constructed with Reduction::dofs. Amplitudes of shapes are lengths.
  void operator()(Reduction& r) const {
    for (int i = 0; i < r.shapes.rows(); ++i) r.shapes.row(i) *= of_dof(i) / factors_.length;
    for (double* omega : {&r.cutoff, &r.highest_kept, &r.first_truncated, &r.highest_massive})
      (*this)(*omega, unit::rate);
    for (ComplianceShare& share : r.shares) {
      (*this)(share.compliance, Unit{-1, 1, 0});
      (*this)(share.residual, Unit{-1, 1, 0});
    }
    for (Eigen::Index i = 0; i < r.stiffness_terms.size(); ++i)
      (*this)(r.stiffness_terms.data()[i], Unit{1, -1, 0});
    (*this)(r.ringing, unit::length);
    (*this)(r.initial_displacement_lost, unit::length);
    (*this)(r.initial_velocity_lost, unit::velocity);
  }

 private:
  Factors factors_;
  const std::vector<Dof>& dofs_;
};

void rescale_drawing(Model& model, const Rescaling& rescale) {
  for (DrawnElement& e : model.drawing)
    for (double* x : {&e.x1, &e.y1, &e.x2, &e.y2}) rescale(*x, unit::length);
  for (DrawnNode& node : model.drawn_nodes)
    for (double* x : {&node.x, &node.y}) rescale(*x, unit::length);
  for (DrawnContact& c : model.drawn_contacts)
    for (double* x : {&c.x, &c.y}) rescale(*x, unit::length);
}

}  // namespace

History rescaled(History history, const Unit& of, const Factors& factors) {
  scene::visit_numbers(history, of,
                       [&](double& x, const Unit& unit) { x *= scene::factor_of(unit, factors); });
  return history;
}

Model rescaled(Model model, const Factors& factors) {
  const Rescaling rescale(factors, model.dofs);
  rescale(model.mass, Unit{0, 0, 2});
  rescale(model.damping, unit::time);
  rescale(model.stiffness, unit::plain);
  for (Load& load : model.loads) rescale(load);
  for (Contact& contact : model.contacts) rescale(contact);
  for (std::vector<Output>* outputs : {&model.outputs, &model.reaction_sums})
    for (Output& output : *outputs) rescale(output);
  rescale_drawing(model, rescale);
  rescale(model.u0, unit::plain);
  rescale(model.v0, unit::rate);
  for (double& reaction : model.statics.reactions) rescale(reaction, unit::force);
  for (HangerLoad& hanger : model.hangers) {
    rescale(hanger.cold, unit::force);
    rescale(hanger.at_start, unit::force);
    rescale(hanger.hot, unit::force);
  }
  for (StageEnd& end : model.statics.stages)
    for (std::vector<double>* forces : {&end.N, &end.T})
      for (double& force : *forces) rescale(force, unit::force);
  rescale(model.saved_time, unit::time);
  for (SavedState::FinalContact& left : model.saved_contacts) {
    rescale(left.gap, unit::length);
    for (double* length : {&left.ut, &left.slip}) rescale(*length, unit::length);
    rescale(left.vt, unit::velocity);
    for (double* force : {&left.N, &left.T}) rescale(*force, unit::force);
  }
  if (model.geometric) rescale(model.geometric->forces);
  rescale(model.scales);
  rescale(model.alpha, unit::rate);
  rescale(model.beta, unit::time);
  rescale(model.omega1, unit::rate);
  rescale(model.omega_max, unit::rate);
  for (LoadCorrection& seen : model.load_corrections) {
    const Dof* const dofs = model.reduction ? model.reduction->dofs.data() : model.dofs.data();
    const double of_history = scene::factor_of(model.loads[seen.load].history_unit, factors);
    for (Eigen::Index j = 0; j < seen.energies.size(); ++j) {
      const LoadCorrection& other = model.load_corrections[static_cast<std::size_t>(j)];
      seen.energies[j] *= scene::factor_of(unit::energy, factors) /
                          (of_history * scene::factor_of(model.loads[other.load].history_unit, factors));
    }
    for (Eigen::Index i = 0; i < seen.displacements.size(); ++i)
      seen.displacements[i] *= (dofs[i].rotation ? 1.0 : factors.length) / of_history;
  }
  if (model.basis) rescale.basis(*model.basis);
  if (model.ties) Rescaling(factors, model.ties->dofs)(*model.ties);
  if (model.reduction) Rescaling(factors, model.reduction->dofs)(*model.reduction);
  model.unit = {model.unit.force / factors.force, model.unit.length / factors.length,
                model.unit.time / factors.time};
  return model;
}

}  // namespace signorini::model
