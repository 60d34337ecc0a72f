#include "sensitivity/static_rates.hpp"

#include "base/rounding.hpp"
#include "model/statics/held_rows.hpp"
#include "model/statics/static_system.hpp"
#include "sensitivity/forcing_rates.hpp"

namespace signorini {
namespace {

/// P_p of the loads of the static equilibrium.
Vector static_load_rate(const Model& model, const ModelDerivative& derivative) {
  Vector p = Vector::Zero(model.size());
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const Load& load = model.loads[i];
    if (!load.is_static) continue;
    const Piece& piece = load.history.piece(0.0);
    derivative.loads[i].direction.add_to(p, piece.value(0.0));
    const HistoryRates& rates = derivative.loads[i].history;
    if (rates.none()) continue;
    double rate = 0.0;
    const auto which = static_cast<std::size_t>(&piece - load.history.pieces().data());
    add_rate_series(piece, rates.pieces[which], 0.0, 1.0, 1, 1.0, &rate);
    load.direction.add_to(p, rate);
  }
  return p;
}

}  // namespace

std::optional<Vector> static_rate(const Model& model, const ModelDerivative& derivative) {
  Vector p = static_load_rate(model, derivative) - derivative.stiffness * model.u0;
  std::vector<HeldRow> rows;
  std::vector<double> places;
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const Contact& contact = model.contacts[c];
    const double N = -model.statics.reactions[c];
    if (contact.normal_force_given() || !(N < 0.0)) continue;
    const ContactRates& rates = derivative.contacts[c];
    const double moved = rates.gap + rates.normal.dot(model.u0);
    rates.normal.add_to(p, -N);
    if (contact.takes_impulses()) {
      rows.push_back({contact.normal, own_stiffness(model.stiffness, contact.normal), true});
      places.push_back(-moved);
    } else {
      const double kn_rate = -rates.rows[index_of(State::closed)].normal.gap;
      contact.normal.add_to(p, -(kn_rate * contact.gap_at(model.u0) + contact.normal_stiffness * moved));
      rows.push_back({contact.normal, contact.normal_stiffness, false});
      places.push_back(0.0);
    }
  }
  const auto solve = [&] {
    const HeldRows held(model.stiffness, rows);
    std::optional<Vector> w;
    if (held.regular())
      w = held.solve(p, Eigen::Map<const Vector>(places.data(), static_cast<Eigen::Index>(places.size())))
              .first;
    return w;
  };
  std::optional<Vector> w = solve();
  for (std::size_t c = 0; !w && c < model.contacts.size(); ++c) {
    const Combination& tangent = model.contacts[c].tangent;
    if (tangent.terms.empty() ||
        std::abs(tangent.dot(model.u0)) > rounding::of_elimination * model.u0.cwiseAbs().maxCoeff())
      continue;
    rows.push_back({tangent, own_stiffness(model.stiffness, tangent), true});
    places.push_back(-derivative.contacts[c].tangent.dot(model.u0));
    w = solve();
  }
  return w;
}

}  // namespace signorini
