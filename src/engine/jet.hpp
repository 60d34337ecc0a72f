// jet.hpp: the motion to one side of an instant as a Taylor series, exact for the linear system of a mode.
//
//   M u^(k+2) + C u^(k+1) + K u^(k) + sum ( n N^(k) + t T^(k) ) = P^(k),   rows of the mode derived k times
//
// Level k is one solve with the system matrix: its unknowns are u^(k+2) where there is mass, u^(k+1) of
// massless degrees of freedom with damping, u^(k) of those without, N^(k) and T^(k). So u, v at an
// instant give consistent forces and accelerations (level 0), and all one-sided derivatives.
//
// Each jet is computed twice, the second time with data and right-hand sides disturbed by one rounding:
// the difference tells which of its entries are zero to working precision.
#pragma once

#include "contact/transition.hpp"
#include "engine/point.hpp"
#include "engine/system_matrix.hpp"

namespace signorini {

/// Derivatives: u[k] of order k (length n), forces[k] = (N_1, T_1, N_2, ...)^(k).
struct Jet {
  double t = 0.0;
  std::vector<Vector> u, forces;

  [[nodiscard]] const Vector& v() const { return u[1]; }
  [[nodiscard]] const Vector& a() const { return u[2]; }
};

class Expander {
 public:
  /// The orders up to which motions of contacts are needed to decide their states.
  static constexpr int orders = 4;

  Expander(const Model& model, const Structure& structure);

  /// Puts a mode in force. False: its rows are linearly dependent, forces would not be unique.
  bool set(const Mode& mode);
  /// The jet at t from u and v (v of massless degrees of freedom is not read).
  [[nodiscard]] Jet expand(const Forcing& forcing, double t, const Vector& u, const Vector& v) const;
  /// The motion of every contact, orders 0 to `orders`, with its noise.
  [[nodiscard]] std::vector<MotionJet> motions(const Forcing& forcing, const Jet& jet) const;
  /// Level 0 alone: makes forces, accelerations and v of massless degrees of freedom consistent with u, v.
  void consistent(const Forcing& forcing, double t, Point& point) const;
  /// v += the smallest impulsive change that makes t.v equal the surface velocity at contacts that
  /// stick without tangential stiffness.
  void hold(const Forcing& forcing, double t, const Mode& mode, Vector& v) const;

 private:
  enum class Kind : unsigned char { massive, damped, algebraic };
  struct Disturbance;
  void level(const Forcing& forcing, double t, int k, Jet& jet, const Disturbance* disturbance) const;
  [[nodiscard]] Jet expand(const Forcing& forcing, double t, const Vector& u, const Vector& v, int levels,
                           const Disturbance* disturbance) const;
  [[nodiscard]] ContactMotion motion(const Forcing& forcing, const Jet& jet, std::size_t contact,
                                     std::size_t order) const;
  /// The same entries with the magnitudes of the terms that are summed in them.
  [[nodiscard]] ContactMotion magnitude(const Forcing& forcing, const Jet& jet, std::size_t contact,
                                        std::size_t order) const;

  const Model& model_;
  const Structure& structure_;
  mutable SystemMatrix matrix_;
  std::vector<Kind> kinds_;
  std::vector<Weights> weights_;
  std::vector<Rows> rows_;
  int levels_;
};

}  // namespace signorini
