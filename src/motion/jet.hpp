// jet.hpp: derivatives of the motion on one side of an instant, exact for the linear system of a contact
// state.
//
//   M u^(k+2) + C u^(k+1) + K u^(k) + sum ( n N^(k) + t T^(k) ) = P^(k),   d^k/dt^k of the state's rows
//
// The derivatives are those of motion/taylor.hpp.
//
// Each jet is computed twice, the second time with data and right-hand sides perturbed by some roundings. The
// difference shows which entries are zero to working precision. Most contacts are far from a change of state,
// so that value and rate decide their state. The second computation ends with the last order that some
// contact needs.
#pragma once

#include <functional>

#include "contact/law.hpp"
#include "motion/taylor.hpp"

namespace signorini::motion {

/// Derivatives at t, order k in column k. u: n rows; forces: of all contacts, in the order of the model's
/// layout.
struct Jet {
  /// Greatest order of contact motions that is needed to decide their states.
  static constexpr int orders = static_cast<int>(MotionJet::orders) - 1;

  double t = 0.0;
  Eigen::MatrixXd u, forces;
  StateSystemPtr system;  ///< system of the contact state, with friction at this instant's slip rates

  /// True for a jet of JetMaker. Local jets (motion/local_derivatives.hpp) end with accelerations and the
  /// rates of forces.
  [[nodiscard]] bool is_complete() const { return forces.cols() > orders; }
  [[nodiscard]] auto v() const { return u.col(1); }
  [[nodiscard]] auto a() const { return u.col(2); }
};

/// Computes jets; the memory for the underlying series belongs to this object.
class JetMaker {
 public:
  explicit JetMaker(StateSystems& systems);

  /// Predicate: true if no query about the contact needs more than the noise of the first `orders` orders of
  /// its motion. The motion itself is known to one order more.
  using StopCriterion = std::function<bool(std::size_t contact, const MotionJet& motion, std::size_t orders)>;

  /// The jet at t from u and v (v of massless degrees of freedom is not read).
  [[nodiscard]] Jet expand(const StateSystemPtr& system, const Forcing& forcing, double t, const Vector& u,
                           const Vector& v);
  /// Same, and computes the motion of every contact, orders 0 to Jet::orders, with its noise. If `enough` is
  /// given, orders that no query needs are not computed, and are undefined. Computed values are bitwise the
  /// same. The motion of contacts that order 0 does not decide is complete. `second` replaces `forcing` in
  /// the second computation, so that the difference between the two forcings counts as noise, too.
  [[nodiscard]] Jet make(const StateSystemPtr& system, const Forcing& forcing, double t, const Vector& u,
                         const Vector& v, std::vector<MotionJet>& motions, const StopCriterion& enough = {},
                         const Forcing* second = nullptr);

 private:
  /// Sums of the magnitudes of the terms whose differences are the accelerations and forces of a contact.
  struct Balance {
    double an, at, N, T;
  };
  /// N and T are nonzero only if the contact's row contains an acceleration.
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
  Series series_, perturbed_;  // series of the last jet
  int levels_;
};

}  // namespace signorini::motion
