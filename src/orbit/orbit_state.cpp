#include "orbit/orbit_state.hpp"

#include "base/eigen_dense.hpp"

namespace signorini::orbit {
namespace {

History from(const History& history, double time) {
  return history.is_constant() && history.starts().empty() ? history : history.shifted(-time);
}

/// Appends to `rows` the coefficients of a linear form in the scaled coordinates, normalised to length 1. places: degrees
/// of freedom of the coordinates from index `first` on.
void add_form(const Combination& form, const std::vector<Eigen::Index>& places, std::size_t first,
              const Vector& scales, std::vector<Vector>& rows) {
  Vector row = Vector::Zero(scales.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    for (const auto& [index, factor] : form.terms)
      if (index == places[i]) {
        const auto at = static_cast<Eigen::Index>(first + i);
        row[at] += factor * scales[at];
      }
  if (row.squaredNorm() > 0.0) rows.push_back(row / row.norm());
}

}  // namespace

OrbitPoint orbit_point(double t, const decide::Decision& after) {
  return {t,
          after.states,
          after.u,
          after.v,
          after.jet.a(),
          after.jet.forces.col(0),
          after.jet.forces.col(1),
          after.system->kinds(),
          after.system->unknowns().layout};
}

OrbitState orbit_state(const OrbitPoint& point) {
  OrbitState state{point.u, point.v, {}, {}};
  for (std::size_t c = 0; c < point.states.size(); ++c) {
    state.shears.push_back(point.forces[static_cast<Eigen::Index>(point.layout.tangent(c))]);
    state.slips.push_back(slip_sign(point.states[c].state));
  }
  return state;
}

Model with_initial_state(Model model, const OrbitState& state) {
  model.u0 = state.u;
  model.v0 = state.v;
  model.static_start = false;
  model.statics = {};
  model.saved_contacts.clear();
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    Contact& contact = model.contacts[c];
    if (contact.tangential_stiffness) contact.initial_shear = state.shears[c];
    if (contact.has_friction()) contact.initial_slip = state.slips[c];
  }
  return model;
}

Model with_shifted_excitation(Model model, double time) {
  if (time == 0.0) return model;
  for (Load& load : model.loads) load.history = from(load.history, time);
  for (Contact& contact : model.contacts) {
    contact.normal_force = from(contact.normal_force, time);
    const History surface = from(contact.surface_motion, time);
    contact.surface_motion = surface.scaled(1.0, -surface.value(0.0));
  }
  if (model.ties)
    for (Ties::Given& given : model.ties->given) given.motion = from(given.motion, time);
  return model;
}

OrbitSection::OrbitSection(const Model& model, const OrbitPoint& at) : model_(model) {
  std::vector<double> u, v, T;
  const Scales& s = model.scales;
  for (Eigen::Index i = 0; i < at.u.size(); ++i) {
    const linear::DofKind kind = at.kinds[static_cast<std::size_t>(i)];
    const bool turns = model.dofs[static_cast<std::size_t>(i)].rotation;
    if (kind != linear::DofKind::algebraic) {
      u_.push_back(i);
      u.push_back(turns ? s.rotation : s.displacement);
    }
    if (kind != linear::DofKind::massive) continue;
    v_.push_back(i);
    v.push_back(turns ? s.angular_velocity : s.velocity);
  }
  for (std::size_t c = 0; c < at.states.size(); ++c)
    if (model.contacts[c].tangential_stiffness && at.states[c].state == State::stick) {
      shears_.push_back(c);
      T.push_back(s.force);
    }
  u.insert(u.end(), v.begin(), v.end());
  u.insert(u.end(), T.begin(), T.end());
  scales_ = Eigen::Map<const Vector>(u.data(), static_cast<Eigen::Index>(u.size()));
  std::vector<Vector> rows;
  for (std::size_t c = 0; c < at.states.size(); ++c) {
    const Contact& contact = model.contacts[c];
    if (contact.takes_impulses() && !at.states[c].is_open()) {
      add_form(contact.normal, u_, 0, scales_, rows);
      add_form(contact.normal, v_, u_.size(), scales_, rows);
    }
    if (contact.sticks_rigidly() && at.states[c].state == State::stick)
      add_form(contact.tangent, v_, u_.size(), scales_, rows);
  }
  if (rows.empty()) {
    basis_ = Eigen::MatrixXd::Identity(scales_.size(), scales_.size());
    return;
  }
  Eigen::MatrixXd held(scales_.size(), static_cast<Eigen::Index>(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) held.col(static_cast<Eigen::Index>(k)) = rows[k];
  basis_ = base::orthogonal_complement(held);
}

Vector OrbitSection::coordinates(const Vector& u, const Vector& v, const Vector& forces) const {
  Vector z(scales_.size());
  Eigen::Index at = 0;
  for (const Eigen::Index i : u_) z[at++] = u[i];
  for (const Eigen::Index i : v_) z[at++] = v[i];
  for (const std::size_t c : shears_) z[at++] = forces[static_cast<Eigen::Index>(model_.layout.tangent(c))];
  return z.cwiseQuotient(scales_);
}

Vector OrbitSection::spread(const Vector& of_dofs) const {
  Vector z = Vector::Ones(scales_.size());
  Eigen::Index at = 0;
  for (const Eigen::Index i : u_) z[at++] = of_dofs[i];
  for (const Eigen::Index i : v_) z[at++] = of_dofs[i];
  return z;
}

Vector OrbitSection::coordinates(const OrbitPoint& point) const {
  return coordinates(point.u, point.v, point.forces);
}

Vector OrbitSection::rates(const OrbitPoint& point) const {
  return coordinates(point.v, point.a, point.force_rates);
}

OrbitState OrbitSection::unscaled(const Vector& dz) const {
  const Vector z = dz.cwiseProduct(scales_);
  OrbitState d{Vector::Zero(model_.size()),
               Vector::Zero(model_.size()),
               std::vector<double>(model_.contacts.size(), 0.0),
               {}};
  Eigen::Index at = 0;
  for (const Eigen::Index i : u_) d.u[i] = z[at++];
  for (const Eigen::Index i : v_) d.v[i] = z[at++];
  for (const std::size_t c : shears_) d.shears[c] = z[at++];
  return d;
}

OrbitState OrbitSection::moved(OrbitState state, const Vector& x) const {
  const OrbitState d = unscaled(basis_ * x);
  state.u += d.u;
  state.v += d.v;
  for (std::size_t c = 0; c < state.shears.size(); ++c) state.shears[c] += d.shears[c];
  return state;
}

}  // namespace signorini::orbit
