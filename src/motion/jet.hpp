// jet.hpp: the motion to one side of an instant as a Taylor series, exact for the linear system of a mode.
//
//   M u^(k+2) + C u^(k+1) + K u^(k) + sum ( n N^(k) + t T^(k) ) = P^(k),   rows of the mode derived k times
//
// The derivatives are those of motion/taylor.hpp.
//
// Each jet is computed twice, the second time with data and right-hand sides disturbed by one rounding:
// the difference tells which of its entries are zero to working precision. Most contacts are far from a change of
// state: value and rate tell it, and the second time ends with the last order that some contact is asked for.
#pragma once

#include <functional>

#include "contact/transition.hpp"
#include "motion/taylor.hpp"

namespace signorini {

/// Derivatives: column k of order k. u: n rows; forces: of all contacts, in the order of the model's layout.
struct Jet {
  /// The orders up to which motions of contacts are needed to decide their states.
  static constexpr int orders = static_cast<int>(MotionJet::orders) - 1;

  double t = 0.0;
  Eigen::MatrixXd u, forces;
  ModeSystemPtr system;  ///< of the mode, with friction at the slip rates of this instant

  /// As JetMaker makes it. Near jets (motion/near_jets.hpp) end with accelerations and the rates of forces.
  [[nodiscard]] bool whole() const { return forces.cols() > orders; }
  [[nodiscard]] auto v() const { return u.col(1); }
  [[nodiscard]] auto a() const { return u.col(2); }
};

/// Makes jets; room for the series behind them is its own.
class JetMaker {
 public:
  explicit JetMaker(ModeSystems& systems);

  /// Is all told that will be asked of a contact, once the noise of the first `orders` orders of its motion is known? The
  /// motion itself is known one order further.
  using Told = std::function<bool(std::size_t contact, const MotionJet& motion, std::size_t orders)>;

  /// The jet at t from u and v (v of massless degrees of freedom is not read).
  [[nodiscard]] Jet expand(const ModeSystemPtr& system, const Forcing& forcing, double t, const Vector& u,
                           const Vector& v);
  /// The same, and the motion of every contact in it, orders 0 to Jet::orders, with its noise. `told`, where it is given:
  /// orders that a contact is not asked for are not made, and hold anything. Of contacts for which order 0 does not tell
  /// all, the motion is complete. What is made is the same to the last bit. second: acts in place of `forcing` the second
  /// time, so that what differs between them counts as noise, too.
  [[nodiscard]] Jet make(const ModeSystemPtr& system, const Forcing& forcing, double t, const Vector& u,
                         const Vector& v, std::vector<MotionJet>& motions, const Told& told = {},
                         const Forcing* second = nullptr);

 private:
  /// Sums of the magnitudes of the terms that accelerations and forces of a contact are differences of.
  struct Balance {
    double an, at, N, T;
  };
  /// Forces: of rows that hold an acceleration, else 0.
  [[nodiscard]] Balance balance_of(const Contact& contact, const Rows& rows, double factorial,
                                   std::size_t k) const;
  void tell(const ModeSystem& system, const Forcing& forcing, const Disturbance& disturbance,
            const Told& told, std::vector<MotionJet>& result);
  void rates(std::size_t contact, std::size_t first, std::size_t last, MotionJet& result) const;
  void motions(const ModeSystem& system, std::size_t contact, std::size_t first, std::size_t last,
               MotionJet& result) const;

  const Model& model_;
  Taylor taylor_;
  Series series_, disturbed_;  // of the last jet
  int levels_;
};

}  // namespace signorini
