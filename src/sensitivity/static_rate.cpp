#include "sensitivity/static_rate.hpp"

#include <cmath>

#include "base/eigen_dense.hpp"
#include "model/statics/free_motions.hpp"
#include "model/statics/mechanisms.hpp"
#include "model/statics/static_system.hpp"
#include "sensitivity/forcing_rates.hpp"

namespace signorini::sensitivity {
namespace {

/// Derivative of the value at t = 0 of a history.
double rate_at_start(const History& history, const HistoryRates& rates) {
  if (rates.none()) return 0.0;
  const Piece& piece = history.piece(0.0);
  const auto which = static_cast<std::size_t>(&piece - history.pieces().data());
  double rate = 0.0;
  add_rate_series(piece, rates.pieces[which], 0.0, 1.0, 1, 1.0, &rate);
  return rate;
}

/// P_p of the loads that act in the static equilibrium.
Vector static_load_rate(const Model& model, const ModelDerivative& derivative) {
  Vector p = Vector::Zero(model.size());
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const Load& load = model.loads[i];
    if (!load.is_static) continue;
    derivative.loads[i].direction.add_to(p, load.history.value(0.0));
    load.direction.add_to(p, rate_at_start(load.history, derivative.loads[i].history));
  }
  return p;
}

class StaticRate {
 public:
  StaticRate(const Model& model, const ModelDerivative& derivative)
      : model_(model),
        derivative_(derivative),
        load_(static_load_rate(model, derivative) - derivative.stiffness * model.u0),
        forces_(model.contacts.size(), 0.0),
        force_rates_(forces_) {
    for (std::size_t c = 0; c < model.contacts.size(); ++c) add(c);
  }

  [[nodiscard]] std::optional<Vector> find() {
    const Vector places = Eigen::Map<const Vector>(places_.data(), static_cast<Eigen::Index>(places_.size()));
    const statics::ConstraintRows held(model_.stiffness, rows_);
    if (held.regular()) return held.solve(load_, places).first;
    const Eigen::MatrixXd motions = statics::null_motions(held.matrix());
    std::vector<const Combination*> tangents;
    for (std::size_t c = 0; c < forces_.size(); ++c)
      if (forces_[c] > 0.0) tangents.push_back(&model_.contacts[c].tangent);
    const std::vector<std::size_t> fixing = statics::fixing_forms(motions, tangents);
    if (static_cast<Eigen::Index>(fixing.size()) < motions.cols()) return std::nullopt;
    std::vector<Combination> pins;
    for (const std::size_t i : fixing) pins.push_back(*tangents[i]);
    const statics::ConstraintRows pinned(model_.stiffness, rows_, pins);
    if (!pinned.regular()) return std::nullopt;
    auto [w, rates] = pinned.solve(load_, places);
    for (std::size_t i = 0; i < supports_.size(); ++i)  // |N| = -N
      force_rates_[supports_[i]] -= rates[static_cast<Eigen::Index>(i)];
    share(pinned, motions, w);
    return std::move(w);
  }

 private:
  /// The row of a closed contact, or the force of a slider.
  void add(std::size_t c) {
    const Contact& contact = model_.contacts[c];
    const ContactRates& rates = derivative_.contacts[c];
    if (contact.normal_force_given()) {
      const double force = contact.normal_force.value(0.0);
      forces_[c] = std::abs(force);
      force_rates_[c] = std::copysign(1.0, force) * rate_at_start(contact.normal_force, rates.normal_force);
      return;
    }
    const double N = -model_.statics.reactions[c];
    if (!(N < 0.0)) return;
    forces_[c] = -N;
    supports_.push_back(c);
    const double moved = rates.gap + rates.normal.dot(model_.u0);
    rates.normal.add_to(load_, -N);
    if (contact.takes_impulses()) {
      rows_.push_back(
          {contact.normal, statics::structural_stiffness(model_.stiffness, contact.normal), true});
      places_.push_back(-moved);
    } else {
      const double kn_rate = -rates.rows[index_of(State::closed)].normal.gap;
      const double known = kn_rate * contact.gap_at(model_.u0) + contact.normal_stiffness * moved;
      contact.normal.add_to(load_, -known);
      force_rates_[c] = -known;
      rows_.push_back({contact.normal, contact.normal_stiffness, false});
      places_.push_back(0.0);
    }
  }

  /// Adds to w the part along the free motions (n x m).
  void share(const statics::ConstraintRows& pinned, const Eigen::MatrixXd& motions, Vector& w) const {
    Vector slipping = Vector::Zero(model_.size()), change = slipping;
    Eigen::MatrixXd resistance = Eigen::MatrixXd::Zero(motions.cols(), motions.cols());
    for (std::size_t c = 0; c < forces_.size(); ++c) {
      if (!(forces_[c] > 0.0)) continue;
      const Combination &t = model_.contacts[c].tangent, &rate = derivative_.contacts[c].tangent;
      const double s = t.dot(model_.u0);
      t.add_to(slipping, forces_[c] * s);
      t.add_to(change, force_rates_[c] * s + forces_[c] * (rate.dot(model_.u0) + t.dot(w)));
      rate.add_to(change, forces_[c] * s);
      Eigen::VectorXd along(motions.cols());
      for (Eigen::Index j = 0; j < along.size(); ++j) along[j] = t.dot(motions.col(j));
      resistance += forces_[c] * along * along.transpose();
    }
    const Vector none = Vector::Zero(static_cast<Eigen::Index>(rows_.size()));
    const auto [y, forces] = pinned.solve(-slipping, none);
    change += derivative_.stiffness * y;
    for (std::size_t i = 0; i < supports_.size(); ++i)
      derivative_.contacts[supports_[i]].normal.add_to(change, forces[static_cast<Eigen::Index>(i)]);
    w -= motions * base::solve_dense(resistance, motions.transpose() * change);
  }

  const Model& model_;
  const ModelDerivative& derivative_;
  Vector load_;
  std::vector<statics::ConstraintRow> rows_;
  std::vector<double> places_;
  std::vector<std::size_t> supports_;         // contacts of the rows
  std::vector<double> forces_, force_rates_;  // |N| and |N|_p, by contact
};

}  // namespace

std::optional<Vector> static_rate(const Model& model, const ModelDerivative& derivative) {
  return StaticRate(model, derivative).find();
}

}  // namespace signorini::sensitivity
