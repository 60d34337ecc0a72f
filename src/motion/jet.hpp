// jet.hpp: time derivatives of the motion on one side of an instant, exact for the linear system of a contact state.
//
//   M u^(k+2) + C u^(k+1) + K u^(k) + sum ( n N^(k) + t T^(k) ) = P^(k),   d^k/dt^k of the state's rows
//
// The derivatives are computed by motion/taylor.hpp. Each jet is computed twice, the second time with data and right-hand
// sides perturbed by a few rounding errors; the difference shows which entries are zero to working precision. Most contacts
// are far from a change of state, and values and rates of their guards already decide the state. So the second computation
// ends with the highest order that some contact needs.
#pragma once

#include <functional>

#include "contact/law.hpp"
#include "motion/taylor.hpp"

namespace signorini::motion {

/// Derivatives at t; column k: order k. u: n rows; forces: forces of all contacts, in the order of the model's layout.
struct Jet {
  /// Largest order of contact motions that may be needed to decide contact states.
  static constexpr int orders = static_cast<int>(MotionJet::orders) - 1;

  double t = 0.0;
  Eigen::MatrixXd u, forces;
  StateSystemPtr system;  ///< system of the contact state, with friction at the slip rates of this instant

  /// True for a jet of JetMaker. A local jet (motion/local_derivatives.hpp) contains only u, v, accelerations, forces and
  /// rates of forces.
  [[nodiscard]] bool is_complete() const { return forces.cols() > orders; }
  [[nodiscard]] auto v() const { return u.col(1); }
  [[nodiscard]] auto a() const { return u.col(2); }
};

/// Computes jets. The object owns the memory of the series that it uses.
class JetMaker {
 public:
  explicit JetMaker(StateSystems& systems);

  /// True if the first `orders` orders of the contact's motion, with their noise, are enough for all later queries. The
  /// motion itself is known to one order more than its noise.
  using StopCriterion = std::function<bool(std::size_t contact, const MotionJet& motion, std::size_t orders)>;

  /// Jet at t from u and v. v of massless degrees of freedom is not used; it is computed.
  [[nodiscard]] Jet expand(const StateSystemPtr& system, const Forcing& forcing, double t, const Vector& u,
                           const Vector& v);
  /// The jet of expand(); also computes orders 0 to Jet::orders of the motion of every contact, with their noise. If `enough`
  /// is given, orders that no query needs are not computed, and the computed ones are bitwise those without `enough`. For a
  /// contact that order 0 does not decide, all orders of the motion are computed, but noise only as far as needed. second:
  /// replaces `forcing` in the second computation, so that the difference of both forcings is part of the noise.
  [[nodiscard]] Jet make(const StateSystemPtr& system, const Forcing& forcing, double t, const Vector& u,
                         const Vector& v, std::vector<MotionJet>& motions, const StopCriterion& enough = {},
                         const Forcing* second = nullptr);

 private:
  /// Sums of the magnitudes of the terms whose differences give the accelerations and the forces of a contact.
  struct Balance {
    double an, at, N, T;
  };
  /// Balance of a contact at order k; factorial: k!. N and T of the balance are nonzero only if the contact's row contains an
  /// acceleration.
  [[nodiscard]] Balance balance_of(const Contact& contact, const Rows& rows, double factorial,
                                   std::size_t k) const;
  void expand_undecided(const StateSystem& system, const Forcing& forcing,
                        const DataPerturbation& disturbance, const StopCriterion& enough,
                        std::vector<MotionJet>& result);
  void rates(std::size_t contact, std::size_t first, std::size_t last, MotionJet& result) const;
  void motions(const StateSystem& system, std::size_t contact, std::size_t first, std::size_t last,
               MotionJet& result) const;

  const Model& model_;
  Taylor taylor_;
  Series series_, perturbed_;  // both series of the last jet
  int levels_;
};

}  // namespace signorini::motion
