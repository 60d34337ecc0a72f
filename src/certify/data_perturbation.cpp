#include "certify/data_perturbation.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "base/rounding.hpp"
#include "contact/constants.hpp"
#include "contact/friction.hpp"
#include "model/assembly/loads.hpp"
#include "model/statics/start_refinement.hpp"

namespace signorini::certify {
namespace {

/// Largest relative change of a datum: a few units in the last place, far less than the accuracy of structural data.
constexpr double rounding_of_data = 1e-15;

/// SplitMix64 (Steele, Lea, Flood 2014): mixes bits well, which suffices for perturbations.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}

/// True if the contact is open at the start, with a gap larger than rounding.
bool is_apart(const Contact& c, const Vector& u0) {
  return !c.normal_force_given() &&
         c.gap_at(u0) > rounding_of_data * (std::abs(c.gap) + c.normal.magnitude(u0));
}

class DataPerturber {
 public:
  explicit DataPerturber(std::uint64_t seed) : seed_(mixed(seed)) {}

  /// Factor 1 + delta r of the datum with this number.
  [[nodiscard]] double factor(std::uint64_t number) const {
    const std::uint64_t bits = mixed(seed_ ^ mixed(number));
    const double size = 0.5 + 0.5 * static_cast<double>(bits >> 12U) * 0x1p-52;
    return 1.0 + ((bits & 1U) != 0U ? size : -size) * rounding_of_data;
  }
  /// Factor 1 + delta r of the next datum.
  double next() { return factor(++number_); }

  void matrix(SparseMatrix& a) {
    const std::uint64_t own = mixed(++number_);
    for (int column = 0; column < a.outerSize(); ++column)
      for (SparseMatrix::InnerIterator entry(a, column); entry; ++entry) {
        const auto low = static_cast<std::uint64_t>(std::min(entry.row(), entry.col()));
        const auto high = static_cast<std::uint64_t>(std::max(entry.row(), entry.col()));
        entry.valueRef() *= factor(own ^ mixed((high << 32U) | low));
      }
  }

  /// For reduced models: perturbs the diagonal of K by rounding errors of the terms that cancel in it.
  void shapes(const Reduction& reduction, SparseMatrix& k) {
    for (Eigen::Index j = 0; j < reduction.stiffness_terms.rows(); ++j) {
      const double terms = reduction.stiffness_terms(j, j), own = k.coeff(j, j);
      if (own > 0.0 && terms > own) k.coeffRef(j, j) += (next() - 1.0) * terms;
    }
  }
  /// For reduced models: perturbs the products x^T K y of different shapes, which rotates the shapes.
  void products(Model& near) {
    const std::uint64_t own = mixed(++number_);
    perturb_shapes(
        [&](Eigen::Index i, Eigen::Index j) {
          const auto low = static_cast<std::uint64_t>(std::min(i, j));
          const auto high = static_cast<std::uint64_t>(std::max(i, j));
          return factor(own ^ mixed((high << 32U) | low)) - 1.0;
        },
        near);
  }

  void history(History& h) {
    if (h.is_constant() && h.value(0.0) == 0.0) return;
    h = h.scaled(next());
  }

  void contact(Contact& c, const Vector& u0) {
    if (is_apart(c, u0)) c.gap *= next();
    contact::visit_stiffnesses(c, [this](double& x, const Unit&) { x *= next(); });
    // Equal constants of a contact law remain equal, for example a stiffness that occurs in two equations of the law.
    if (auto law = c.law->with_constants([this](double& x, const Unit&) {
          x *= factor(mixed(number_) ^ std::bit_cast<std::uint64_t>(std::abs(x)));
        }))
      c.law = std::move(law);
    const double friction = next();  // one factor for both, so that equal coefficients remain equal
    c.friction.static_ *= friction;
    c.friction.kinetic *= friction;
    if (c.restitution < 1.0) c.restitution = std::min(1.0, c.restitution * next());
    history(c.normal_force);
    history(c.surface_motion);
  }

 private:
  std::uint64_t seed_, number_ = 0;
};

/// For each degree of freedom: a contact that touches at the start acts on it.
std::vector<bool> touched(const Model& model) {
  std::vector<bool> list(static_cast<std::size_t>(model.size()), false);
  for (const Contact& c : model.contacts)
    if (!is_apart(c, model.u0))
      for (const Combination* form : {&c.normal, &c.tangent, &c.body_tangent()})
        for (const auto& [dof, factor] : form->terms) list[static_cast<std::size_t>(dof)] = true;
  return list;
}

}  // namespace

double random_sign(std::uint64_t seed, std::uint64_t number) {
  return (mixed(mixed(seed) ^ mixed(number)) & 1U) != 0U ? 1.0 : -1.0;
}

Model perturbed(const Model& model, std::uint64_t seed) {
  Model near = model;
  DataPerturber disturb(seed);
  disturb.matrix(near.mass);
  disturb.matrix(near.damping);
  disturb.matrix(near.stiffness);
  if (model.reduction) disturb.shapes(*model.reduction, near.stiffness);
  for (Load& load : near.loads) disturb.history(load.history);
  for (Contact& contact : near.contacts) disturb.contact(contact, model.u0);
  const std::vector<bool> touches = touched(model);
  for (int i = 0; i < near.size(); ++i) {
    if (touches[static_cast<std::size_t>(i)]) continue;
    near.v0[i] *= disturb.next();
    if (!model.static_start) near.u0[i] *= disturb.next();
  }
  if (model.reduction) disturb.products(near);
  if (const auto moved = perturbed_start(model, near)) {  // a static start follows from the perturbed data
    near.u0 += moved->w;
    for (std::size_t k = 0; k < near.contacts.size(); ++k) near.contacts[k].initial_shear = moved->shears[k];
  }
  return near;
}

namespace {

// Half of the digits of a double: larger entries of the first-order approximation C are not valid.
constexpr double max_mixed = 1e-8;

/// Matrix C; rows of shapes without mass are zero, because their frequency is infinite.
Eigen::MatrixXd mixing(const std::function<double(Eigen::Index, Eigen::Index)>& coupling,
                       const Model& model) {
  const Eigen::MatrixXd& terms = model.reduction->stiffness_terms;
  const Eigen::Index size = terms.rows();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const double mass = model.mass.coeff(i, i);
    if (!(mass > 0.0)) continue;
    const double square = model.stiffness.coeff(i, i) / mass;
    for (Eigen::Index j = 0; j < size; ++j) {
      if (j == i || terms(i, j) == 0.0) continue;
      const double coupled = coupling(i, j) * terms(i, j);
      const double apart = square * model.mass.coeff(j, j) - model.stiffness.coeff(j, j);
      if (std::abs(coupled) < max_mixed * std::abs(apart)) result(i, j) = coupled / apart;
    }
  }
  return result;
}

/// Replaces f_i by f_i + sum_j C_ij f_j. Coefficients of degrees of freedom that are not shapes do not change.
void mix(const Eigen::MatrixXd& c, Combination& form) {
  Vector f = Vector::Zero(c.rows());
  Combination mixed, beside;
  for (const auto& [dof, factor] : form.terms)
    if (dof < c.rows())
      f[dof] += factor;
    else
      beside.terms.emplace_back(dof, factor);
  f += c * f;
  for (Eigen::Index i = 0; i < f.size(); ++i)
    if (f[i] != 0.0) mixed.terms.emplace_back(static_cast<int>(i), f[i]);
  mixed.terms.insert(mixed.terms.end(), beside.terms.begin(), beside.terms.end());
  form = std::move(mixed);
}

}  // namespace

void perturb_shapes(const std::function<double(Eigen::Index, Eigen::Index)>& coupling, Model& model) {
  const Eigen::MatrixXd c = mixing(coupling, model);
  // u = X q = X' q' gives q' = q - C^T q. Gaps at the start do not change.
  const Vector u0 = model.u0;
  for (Vector* q : {&model.u0, &model.v0}) q->head(c.rows()) -= c.transpose() * q->head(c.rows()).eval();
  for (Contact& contact : model.contacts) {
    const double before = contact.normal.dot(u0);
    contact::visit_forms(contact, [&](Combination& form) { mix(c, form); });
    if (!contact.normal_force_given()) contact.gap += before - contact.normal.dot(model.u0);
  }
  for (Load& load : model.loads) mix(c, load.direction);
  model.reduction->shapes += model.reduction->shapes * c.transpose();
}

namespace {

// A contact closer to its friction limit than this fraction of the limit may slide. Starts of reduced models use the same
// value.
constexpr double at_limit = 1e-9;
// Unbalanced forces up to this part of the largest term are the error of the start; greater ones are loads that act at t = 0
// and are not static. Half of the digits; chosen value, the same as for starts of reduced models.
constexpr double most_rounding = 1e-8;

bool rubs(const Model& model, const Contact& c) { return model.statics.frictional && c.has_friction(); }

bool bears(const Model& model, std::size_t k) { return model.statics.reactions[k] > 0.0; }

double rounding_of_gap(const Contact& contact, const Vector& u) {
  return rounding::elimination * (std::abs(contact.gap) + contact.normal.magnitude(u));
}

/// Forces of the start: N of contact springs follows from their gaps, N of rigid contacts is that of the start, and T that
/// of the last stage where the contact has no spring that keeps it.
statics::StartForces forces_at_start(const Model& model) {
  statics::StartForces start{model.u0, {}, {}};
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    start.N.push_back(-model.statics.reactions[k]);
    if (!c.normal_force_given() && bears(model, k) && c.normal_spring())
      start.N.back() = c.normal_stiffness * c.gap_at(model.u0);
    const bool stored = c.tangential_stiffness || model.statics.stages.empty();
    start.T.push_back(!rubs(model, c) || !bears(model, k) ? 0.0
                      : stored                            ? c.initial_shear
                                                          : model.statics.stages.back().T[k]);
  }
  return start;
}

/// States of the contacts at the start of `model`, with the friction of `near`.
std::vector<statics::HeldContact> states_at_start(const Model& model, const Model& near,
                                                  const statics::StartForces& start) {
  std::vector<statics::HeldContact> held(model.contacts.size());
  for (std::size_t k = 0; k < held.size(); ++k) {
    const Contact &c = model.contacts[k], &other = near.contacts[k];
    statics::HeldContact& state = held[k];
    if (!c.normal_force_given() && bears(model, k))
      state.normal = statics::HeldContact::Normal::closed;
    else if (!c.normal_force_given() && std::abs(c.gap_at(model.u0)) <= rounding_of_gap(c, model.u0))
      state.normal = statics::HeldContact::Normal::touching;
    if (!rubs(model, c) || !bears(model, k)) continue;
    const double N = start.N[k], T = start.T[k];
    if (std::abs(T) < (1.0 - at_limit) * contact::sticking_limit(c, N)) {
      state.sticks = true;
    } else {
      state.slips = T < 0.0 ? -1 : 1;
      state.friction = N < 0.0 ? contact::sticking_limit(other, N) / -N : 0.0;
    }
  }
  return held;
}

/// True if no gap with a contact spring changes its sign from model.u0 to u; gaps within rounding are ignored.
bool keeps_states(const Model& model, const Model& near, const Vector& u) {
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    if (!c.normal_spring()) continue;
    const double before = c.gap_at(model.u0);
    if (std::abs(before) > rounding_of_gap(c, model.u0) && before * near.contacts[k].gap_at(u) <= 0.0)
      return false;
  }
  return true;
}

/// True for a static start whose contacts have states that the equations of statics::refine_start() describe.
bool is_known(const Model& model) {
  const std::size_t count = model.contacts.size();
  if (!model.static_start || model.statics.reactions.size() != count) return false;
  if (!model.statics.stages.empty() && model.statics.stages.back().T.size() != count) return false;
  return std::all_of(model.contacts.begin(), model.contacts.end(), [&](const Contact& c) {
    if (!c.obeys_coulomb()) return false;
    if (!rubs(model, c)) return true;
    if (c.sliding_point() || c.curved_surface() || c.initial_slip != 0) return false;
    return !(c.sticks_rigidly() && model.statics.stages.empty());
  });
}

}  // namespace

std::optional<PerturbedStart> perturbed_start(const Model& model, const Model& near) {
  if (!is_known(model)) return std::nullopt;
  statics::StartForces start = forces_at_start(model);
  const std::vector<statics::HeldContact> held = states_at_start(model, near, start);
  double size = 0.0;
  Vector load = assembly::static_load(near.loads, near.size());
  const Vector rest = statics::unbalanced_forces(
      model.stiffness, assembly::static_load(model.loads, model.size()), model.contacts, start, size);
  if (rest.size() > 0 && rest.cwiseAbs().maxCoeff() > most_rounding * size) load -= rest;
  for (std::size_t k = 0; k < model.contacts.size(); ++k)  // the sliding points do not move
    if (held[k].sticks && model.contacts[k].tangential_stiffness)
      start.T[k] *= *near.contacts[k].tangential_stiffness / *model.contacts[k].tangential_stiffness;
  start.u = near.u0;
  if (!statics::refine_start(near.stiffness, load, near.contacts, held, start)) return std::nullopt;
  if (!(start.u.allFinite() && keeps_states(model, near, start.u))) return std::nullopt;
  PerturbedStart moved{start.u - near.u0, {}};
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact &c = model.contacts[k], &other = near.contacts[k];
    const double N = other.resting_force(start.u).value_or(start.N[k]);
    const double limit = rubs(model, c) ? contact::sticking_limit(other, N) : 0.0;
    moved.shears.push_back(c.tangential_stiffness && rubs(model, c) && bears(model, k)
                               ? std::clamp(start.T[k], -limit, limit)
                               : c.initial_shear);
  }
  return moved;
}

}  // namespace signorini::certify
