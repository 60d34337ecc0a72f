#include "model/reduce/reduced_start.hpp"

#include <algorithm>
#include <cmath>

#include "contact/friction.hpp"
#include "model/statics/static_system.hpp"

namespace signorini::reduce {
namespace {

// Largest imbalance r, relative to its terms, that is treated as rounding: half of the digits. Chosen value; rounding leaves
// 1e-11, a load that the start does not include leaves its full value.
constexpr double max_rounding_imbalance = 1e-8;
// Several steps are needed, because a step neglects that the friction of sliding contacts changes with N.
constexpr int steps = 3;
// A contact is at its friction limit if its relative distance from the limit is smaller.
constexpr double at_limit = 1e-9;

class ReducedStart {
 public:
  explicit ReducedStart(Model& model) : model_(model) {
    for (std::size_t k = 0; k < model.contacts.size(); ++k) {
      const double limit = limit_of(k), T = std::abs(shear(k));
      shares_.push_back(limit > 0.0 ? std::min(1.0, T / limit) : 0.0);
    }
  }

  struct State {
    Vector u;
    std::vector<double> shears;
  };
  [[nodiscard]] State state() const {
    State result{model_.u0, {}};
    for (const Contact& c : model_.contacts) result.shears.push_back(c.initial_shear);
    return result;
  }
  void set(const State& state) {
    model_.u0 = state.u;
    for (std::size_t k = 0; k < state.shears.size(); ++k) model_.contacts[k].initial_shear = state.shears[k];
  }

  /// Returns the imbalance r, and the magnitude of its largest term.
  [[nodiscard]] std::pair<Vector, double> left_over() const {
    const Vector elastic = model_.stiffness * model_.u0;
    Vector r = -elastic;
    double most = elastic.cwiseAbs().maxCoeff();
    const auto add = [&](const Combination& form, double force) {
      form.add_to(r, force);
      for (const auto& [dof, factor] : form.terms) most = std::max(most, std::abs(factor * force));
    };
    for (const Load& load : model_.loads)
      if (load.is_static) add(load.direction, load.history.value(0.0));
    for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
      add(model_.contacts[k].normal, -normal_force(k));
      add(model_.contacts[k].tangent, -shear(k));
    }
    return {std::move(r), most};
  }

  /// Corrects displacements and shears by one step d (reduced_start.hpp). Returns false if the structure is a mechanism.
  [[nodiscard]] bool step(const Vector& r) {
    std::vector<statics::ConstraintRow> rows;
    std::vector<std::size_t> stuck;
    for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
      const Contact& c = model_.contacts[k];
      if (bears(k))
        rows.push_back({c.normal,
                        c.normal_spring().value_or(statics::structural_stiffness(model_.stiffness, c.normal)),
                        !c.normal_spring()});
      if (!sticks(k)) continue;
      rows.push_back({c.tangent, *c.tangential_stiffness, false});
      stuck.push_back(k);
    }
    const statics::ConstraintRows held(model_.stiffness, rows);
    if (!held.regular()) return false;
    const Vector d = held.solve(r, Vector::Zero(static_cast<Eigen::Index>(rows.size()))).first;
    if (!d.allFinite()) return false;
    model_.u0 += d;
    for (const std::size_t k : stuck)
      model_.contacts[k].initial_shear +=
          *model_.contacts[k].tangential_stiffness * model_.contacts[k].tangent.dot(d);
    clamp();
    return true;
  }

  /// Limits shears to the friction limit; a contact that started at its limit stays at the limit.
  void clamp() {
    for (std::size_t k = 0; k < shares_.size(); ++k) {
      if (!rubs(k)) continue;
      double& T = model_.contacts[k].initial_shear;
      const double limit = limit_of(k);
      T = sticks(k) ? std::clamp(T, -limit, limit) : std::copysign(shares_[k] * limit, T);
    }
  }

 private:
  [[nodiscard]] bool bears(std::size_t k) const {
    return !model_.contacts[k].normal_force_given() && model_.statics.reactions[k] > 0.0;
  }
  [[nodiscard]] bool rubs(std::size_t k) const {
    const Contact& c = model_.contacts[k];
    return model_.statics.frictional && c.has_friction() && c.tangential_stiffness.has_value();
  }
  [[nodiscard]] bool sticks(std::size_t k) const {
    return rubs(k) && limit_of(k) > 0.0 && shares_[k] < 1.0 - at_limit;
  }
  [[nodiscard]] double shear(std::size_t k) const { return rubs(k) ? model_.contacts[k].initial_shear : 0.0; }
  [[nodiscard]] double normal_force(std::size_t k) const {
    const Contact& c = model_.contacts[k];
    if (!bears(k)) return 0.0;
    return c.resting_force(model_.u0).value_or(-model_.statics.reactions[k]);
  }
  [[nodiscard]] double limit_of(std::size_t k) const {
    const Contact& c = model_.contacts[k];
    if (!rubs(k)) return 0.0;
    return contact::sticking_limit(c,
                                   c.normal_force_given() ? -model_.statics.reactions[k] : normal_force(k));
  }
  Model& model_;
  std::vector<double> shares_;  // |T| / limit at the original start
};

bool is_known(const Model& model) {
  return model.static_start && model.statics.reactions.size() == model.contacts.size() &&
         std::none_of(model.contacts.begin(), model.contacts.end(), [&](const Contact& c) {
           return !c.has_constant_stiffness() || (model.statics.frictional && c.sticks_rigidly());
         });
}

}  // namespace

void equilibrate_start(Model& model) {
  if (!is_known(model)) return;
  ReducedStart start(model);
  auto [r, most] = start.left_over();
  if (!(r.cwiseAbs().maxCoeff() <= max_rounding_imbalance * most)) return;
  start.clamp();
  double least = start.left_over().first.norm();
  for (int i = 0; i < steps; ++i) {
    const ReducedStart::State now = start.state();
    if (!start.step(r)) return;
    r = start.left_over().first;
    if (!(r.norm() < least)) {
      start.set(now);
      return;
    }
    least = r.norm();
  }
}

}  // namespace signorini::reduce
