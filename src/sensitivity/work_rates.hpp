// work_rates.hpp: derivatives, with respect to a parameter, of work integrals and losses since t = 0.
//
//   W_p+ = W_p + int d/dp ( power at fixed time ) dt         between instants, by Gauss's rule
//   W_p+ = W_p- + (power- - power+) dt/dp + DL               across an instant with a loss L
//   power: P . v,  v^T C v + cn g'^2,  T p',  -T s',  -N     motion/point.hpp
//   E_p = v^T M w' + v^T M_p v / 2 + u^T K w + ...           stored energy, at one time
//
// L: loss by impacts, drops of friction, and jumps of loads on massless parts (run/audit.hpp). D: derivative along the moving
// instant. Units: internal unit of the quantity / unit of the key.
#pragma once

#include <optional>

#include "linear/system_matrices.hpp"
#include "motion/point.hpp"
#include "sensitivity/contact_rates.hpp"
#include "sensitivity/tangent_event.hpp"

namespace signorini::sensitivity {

/// Derivatives of work integrals and losses with respect to one parameter. friction(), surface(): sums over all contacts.
struct WorkRates {
  motion::WorkIntegrals works;
  double impact = 0.0;

  [[nodiscard]] double friction() const;
  [[nodiscard]] double surface() const;
};

/// All quantities at one time between instants.
struct TangentPlace {
  double t = 0.0;
  const motion::Forcing& forcing;
  const contact::ContactStates& states;
  SeriesPoint motion, tangent;
  std::vector<DrivenRates> driven;  ///< one entry per contact
  Vector load;                      ///< P_p
};

/// u, v and all contact motions with their derivatives, which are taken at fixed time or along an instant.
struct StoredMotion {
  const contact::ContactStates& states;
  const Vector &u, &v, &Du, &Dv;
  const std::vector<ContactMotion>&m, &D;
};

class WorkTangent {
 public:
  /// All arguments must outlive the object.
  WorkTangent(const Model& model, const ModelDerivative& derivative)
      : model_(model), derivative_(derivative), now_{motion::WorkIntegrals(model.contacts.size()), 0.0} {}

  [[nodiscard]] const WorkRates& now() const { return now_; }
  [[nodiscard]] WorkRates& now() { return now_; }
  /// Adds `factor` times the derivatives of all powers at the given place.
  void add(const TangentPlace& place, double factor);
  /// Adds dt times the powers of loads and damping, and dt_of[c] times the powers of contact c.
  void shift(const motion::Forcing& forcing, double t, const contact::ContactStates& states,
             const SeriesPoint& motion, const std::vector<ContactMotion>& m, double dt,
             const std::vector<double>& dt_of);
  /// Derivatives of kinetic, elastic and contact energy; the other members of the result are zero.
  [[nodiscard]] Energy stored(const StoredMotion& at) const;
  [[nodiscard]] double kinetic(const Vector& v, const Vector& Dv) const;

 private:
  [[nodiscard]] double contact_energy(std::size_t c, const StoredMotion& at, double& shear) const;

  const Model& model_;
  const ModelDerivative& derivative_;
  WorkRates now_;
};

/// Derivative kn_p of the normal stiffness, from the derivatives of the rows of a closed contact.
[[nodiscard]] double stiffness_rate(const ContactRates& rates);
/// Derivative cn_p of the normal dashpot constant, from the derivatives of the rows of a closed contact.
[[nodiscard]] double damping_rate(const ContactRates& rates);
/// Derivative of the slip position ut - T/kt.
[[nodiscard]] double slip_derivative(const Contact& contact, const ContactRates& rates,
                                     const ContactMotion& m, const ContactMotion& D);

// Energy lost at an instant, and its derivative with respect to a parameter.
//
//   impact     L = v-^T M v-/2 - v+^T M v+/2 + sum Pt s'
//   friction   L = (T-^2 - T+^2)/2kt                if the force drops
//   massless parts, which respond instantaneously (run/audit.hpp):
//   friction   L = T+ (slip+ - slip-)               at a jump of a load
//              L = released energy                  at a drop of friction at one contact; at several contacts L as above,
//                                                   plus an equal share of the remaining energy
//   loads      W += sum of L - released energy      at a jump of a load
//              W += P . (u+ - u-)                   otherwise; the released energy increases by the same amount
//
// DL and all other derivatives are taken along the moving instant.

class LossRates {
 public:
  /// All arguments must outlive the object. massless: run::has_instantaneous_parts(model).
  LossRates(const Model& model, const ModelDerivative& derivative, bool massless)
      : model_(model), derivative_(derivative), massless_(massless) {}

  /// Passes an instant: changes `works` from the derivatives at fixed time before the instant to those after it. Returns the
  /// derivatives along the instant, including all losses.
  WorkRates pass(const InstantMotion& motion, const TangentBefore& before, const TangentAfter& after,
                 WorkTangent& works) const;

 private:
  struct Sides;
  void add_impact(const Sides& sides, WorkRates& works) const;
  [[nodiscard]] std::optional<double> friction_drop_loss(const Sides& sides, std::size_t contact) const;
  [[nodiscard]] double load_work_rate(const Sides& sides) const;
  void add_drops(const Sides& sides, WorkTangent& works) const;

  const Model& model_;
  const ModelDerivative& derivative_;
  bool massless_;
};

}  // namespace signorini::sensitivity
