#include "certify/data_perturbation.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "base/rounding.hpp"
#include "contact/constants.hpp"
#include "contact/friction.hpp"
#include "model/assembly/loads.hpp"
#include "model/statics/static_system.hpp"

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

bool rubs(const Model& model, const Contact& c) { return model.statics.frictional && c.has_friction(); }

/// True if the contact sticks with a tangential spring and its T is below the friction limit.
bool sticks(const Model& model, std::size_t k) {
  const Contact& c = model.contacts[k];
  const double limit = contact::sticking_limit(c, -model.statics.reactions[k]);
  return c.tangential_stiffness && c.initial_slip == 0 &&
         std::abs(c.initial_shear) < (1.0 - at_limit) * limit;
}

/// initial_shear of each contact with the stiffnesses of `near` and unchanged sliding points.
std::vector<double> shears(const Model& model, const Model& near) {
  std::vector<double> list;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact &c = model.contacts[k], &other = near.contacts[k];
    const bool springs = c.tangential_stiffness && *c.tangential_stiffness > 0.0;
    list.push_back(springs ? c.initial_shear * (*other.tangential_stiffness / *c.tangential_stiffness)
                           : c.initial_shear);
  }
  return list;
}

/// Unbalanced forces r at u0. N of contact springs follows from their gaps; N of rigid contacts is that of the start.
Vector left_over(const Model& model, const std::vector<double>& reactions,
                 const std::vector<double>& shears) {
  Vector force = assembly::static_load(model.loads, model.size()) - model.stiffness * model.u0;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    if (model.statics.frictional && reactions[k] > 0.0 && c.has_friction())
      c.tangent.add_to(force, -shears[k]);
    if (c.normal_force_given() || !(reactions[k] > 0.0)) continue;
    c.normal.add_to(force, c.normal_spring() ? -c.normal_stiffness * c.gap_at(model.u0) : reactions[k]);
  }
  return force;
}

double rounding_of_gap(const Contact& contact, const Vector& u) {
  return rounding::elimination * (std::abs(contact.gap) + contact.normal.magnitude(u));
}

bool bears(const Model& model, std::size_t k) {
  return !model.contacts[k].normal_force_given() && model.statics.reactions[k] > 0.0;
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

/// True for a static start whose loaded contacts with friction all stick below their limits, with tangential springs.
bool is_known(const Model& model) {
  if (!model.static_start || model.statics.reactions.size() != model.contacts.size()) return false;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    if (!c.obeys_coulomb()) return false;
    if (!rubs(model, c)) continue;
    if (c.sliding_point() || c.curved_surface()) return false;
    if (model.statics.reactions[k] > 0.0 && !sticks(model, k)) return false;
  }
  return true;
}

}  // namespace

std::optional<PerturbedStart> perturbed_start(const Model& model, const Model& near) {
  if (!is_known(model)) return std::nullopt;
  PerturbedStart moved{{}, shears(model, near)};
  const std::vector<double>& reactions = model.statics.reactions;
  const Vector p =
      left_over(near, reactions, moved.shears) - left_over(model, reactions, shears(model, model));
  std::vector<statics::ConstraintRow> rows;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = near.contacts[k];
    if (rubs(model, c) && reactions[k] > 0.0) rows.push_back({c.tangent, *c.tangential_stiffness, false});
    if (c.normal_force_given()) continue;
    if (c.normal_spring() && bears(model, k))
      rows.push_back({c.normal, c.normal_stiffness, false});
    else if (bears(model, k) || std::abs(c.gap_at(near.u0)) <= rounding_of_gap(c, near.u0))
      rows.push_back({c.normal, statics::structural_stiffness(near.stiffness, c.normal), true});
  }
  const auto solve = [&]() -> std::optional<Vector> {
    const statics::ConstraintRows held(near.stiffness, rows);
    if (!held.regular()) return std::nullopt;
    return held.solve(p, Vector::Zero(static_cast<Eigen::Index>(rows.size()))).first;
  };
  std::optional<Vector> w = solve();
  // If a rigid-body motion is free, rows ut = 0 are added until the matrix is regular.
  for (std::size_t k = 0; !w && k < model.contacts.size(); ++k) {
    const Combination& tangent = near.contacts[k].tangent;
    if (tangent.terms.empty() ||
        std::abs(tangent.dot(near.u0)) > rounding::elimination * near.u0.cwiseAbs().maxCoeff())
      continue;
    rows.push_back({tangent, statics::structural_stiffness(near.stiffness, tangent), true});
    w = solve();
  }
  if (!w || !(w->allFinite() && keeps_states(model, near, near.u0 + *w))) return std::nullopt;
  for (std::size_t k = 0; k < model.contacts.size(); ++k)
    if (rubs(model, model.contacts[k]) && reactions[k] > 0.0)
      moved.shears[k] += *near.contacts[k].tangential_stiffness * near.contacts[k].tangent.dot(*w);
  moved.w = std::move(*w);
  return moved;
}

}  // namespace signorini::certify
