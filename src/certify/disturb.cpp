#include "certify/disturb.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "certify/mixed_shapes.hpp"
#include "certify/moved_start.hpp"
#include "contact/constants.hpp"

namespace signorini {
namespace {

/// Relative change of each datum: some units in the last place, less than the accuracy of any structural data.
constexpr double rounding_of_data = 1e-15;

/// SplitMix64 (Steele, Lea, Flood 2014): a good bit mixer, which is sufficient here.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}

/// True if the contact has a gap at the start, beyond rounding.
bool is_apart(const Contact& c, const Vector& u0) {
  return !c.normal_force_given() &&
         c.gap_at(u0) > rounding_of_data * (std::abs(c.gap) + c.normal.magnitude(u0));
}

class Disturber {
 public:
  explicit Disturber(std::uint64_t seed) : seed_(mixed(seed)) {}

  /// 1 + delta r, for the datum with this number.
  [[nodiscard]] double factor(std::uint64_t number) const {
    const std::uint64_t bits = mixed(seed_ ^ mixed(number));
    const double size = 0.5 + 0.5 * static_cast<double>(bits >> 12U) * 0x1p-52;
    return 1.0 + ((bits & 1U) != 0U ? size : -size) * rounding_of_data;
  }
  /// Factor of the next datum.
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

  /// For reduced models: perturbs entries of K by the terms that cancel in them.
  void shapes(const Reduction& reduction, SparseMatrix& k) {
    for (Eigen::Index j = 0; j < reduction.stiffness_terms.rows(); ++j) {
      const double terms = reduction.stiffness_terms(j, j), own = k.coeff(j, j);
      if (own > 0.0 && terms > own) k.coeffRef(j, j) += (next() - 1.0) * terms;
    }
  }
  /// Perturbs products with other shapes as well.
  void products(Model& near) {
    const std::uint64_t own = mixed(++number_);
    mix_shapes(
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
    visit_stiffnesses(c, [this](double& x, const Unit&) { x *= next(); });
    // Numbers of a law made of data: equal ones stay equal, such as a stiffness in a row and in a memory.
    if (auto law = c.law->with_constants([this](double& x, const Unit&) {
          x *= factor(mixed(number_) ^ std::bit_cast<std::uint64_t>(std::abs(x)));
        }))
      c.law = std::move(law);
    const double friction = next();  // static and kinetic friction that are equal stay so
    c.friction.static_ *= friction;
    c.friction.kinetic *= friction;
    if (c.restitution < 1.0) c.restitution = std::min(1.0, c.restitution * next());
    history(c.normal_force);
    history(c.surface_motion);
  }

 private:
  std::uint64_t seed_, number_ = 0;
};

/// Degrees of freedom of contacts that touch at the start.
std::vector<bool> touched(const Model& model) {
  std::vector<bool> list(static_cast<std::size_t>(model.size()), false);
  for (const Contact& c : model.contacts)
    if (!is_apart(c, model.u0))
      for (const Combination* form : {&c.normal, &c.tangent, &c.body_tangent()})
        for (const auto& [dof, factor] : form->terms) list[static_cast<std::size_t>(dof)] = true;
  return list;
}

}  // namespace

double sign_by_chance(std::uint64_t seed, std::uint64_t number) {
  return (mixed(mixed(seed) ^ mixed(number)) & 1U) != 0U ? 1.0 : -1.0;
}

Model disturbed(const Model& model, std::uint64_t seed) {
  Model near = model;
  Disturber disturb(seed);
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
  if (const auto moved = moved_start(model, near)) {  // it follows from the other data
    near.u0 += moved->w;
    for (std::size_t k = 0; k < near.contacts.size(); ++k) near.contacts[k].initial_shear = moved->shears[k];
  }
  return near;
}

}  // namespace signorini
