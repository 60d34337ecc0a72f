// taylor.hpp: the motion in one contact state as a Taylor series, exact for its linear system.
//
//   x(t + s z) = sum_k x_k z^k,   x_k = s^k/k! x^(k)(t)
//   M a_k + C v_k + K u_k + sum ( n N_k + t T_k ) = P_k,   rows of the contact state
//   v_k = (k+1)/s u_(k+1),   a_k = (k+1)(k+2)/s^2 u_(k+2)
//
// Level k is one solve with the state's system (motion/mode_system.hpp): its unknowns are a_k of degrees of freedom
// with mass, v_k of massless degrees of freedom with damping, u_k of those without, N_k and T_k. So u, v at an instant
// give consistent forces and accelerations (level 0), and then the whole series, for every kind of system: nonsymmetric
// by friction, singular by free motions, with massless parts or rigid sticking.
#pragma once

#include <functional>

#include "motion/friction_series.hpp"
#include "motion/mode_systems.hpp"
#include "motion/point.hpp"

namespace signorini {

/// Some roundings of all terms of all equations, irregular but reproducible: equal disturbances would leave cancelling
/// sums unchanged, so that an accidental zero would look like one of the equations.
struct Disturbance {
  const Series& motion;  ///< undisturbed: source of the terms

  static constexpr double most = 8.0;  ///< number of roundings: results show them above their last digit
  /// +-(1/2 .. 1) most eps
  static double part(std::size_t i);
};

/// Expands one series at a time; apart from the state's system it uses only its own memory.
class Taylor {
 public:
  explicit Taylor(ModeSystems& systems);

  /// Expands the series about t from u and v (v of massless degrees of freedom is not read).
  void expand(const ModeSystemPtr& system, const Forcing& forcing, double t, const Vector& u, const Vector& v,
              int levels, double scale, Series& out, const Disturbance* disturbance = nullptr);
  /// Same in two parts: memory for `levels`, then the levels up to the given one.
  void begin(const ModeSystemPtr& system, const Forcing& forcing, double t, const Vector& u, const Vector& v,
             int levels, double scale, Series& out, const Disturbance* disturbance = nullptr);
  void extend(const Forcing& forcing, int levels, Series& out, const Disturbance* disturbance = nullptr);

  /// Additional loads on the structure at a level, for all later series; the function must outlive them.
  using Besides = std::function<void(int level, double* P)>;
  void act_besides(Besides besides) { besides_ = std::move(besides); }

  /// 1 over the mass of each degree of freedom alone, 0 for massless ones.
  [[nodiscard]] const std::vector<double>& mobility() const { return mobility_; }
  /// The system of the last series: that of its contact state, with friction at its slip rates.
  [[nodiscard]] const ModeSystemPtr& system() const { return system_; }
  [[nodiscard]] bool massless() const { return massless_; }
  /// Column k: sum of the magnitudes of the terms of each equation at level k of the last disturbed series.
  /// n + 2 contacts rows.
  [[nodiscard]] const Eigen::MatrixXd& terms() const { return terms_; }

 private:
  void start_friction(const Forcing& forcing, Series& series);
  void settle_doubts(const Forcing& forcing, Series& series);
  [[nodiscard]] ModeSystemPtr at_friction() const;
  void add_bowls(int k, const Series& series);
  [[nodiscard]] double pinned_value(const Pinned& pinned, int k, const Series& series) const;
  void known_of_rows(std::size_t contact, int k, const Series& series, double& normal, double& tangent) const;
  void level(const Forcing& forcing, int k, Series& series, const Disturbance* disturbance);
  template <std::size_t fixed_n, std::size_t fixed_size>
  void level_dense(const Forcing& forcing, int k, Series& series);
  void level_any(const Forcing& forcing, int k, Series& series, const Disturbance* disturbance);
  void know_motion(int k, const Series& series);
  void measure_equations(const Forcing& forcing, int k, const Series& series, double* terms) const;
  void measure_forces(std::size_t contact, int k, const Series& series, double* terms) const;
  void measure_rows(std::size_t contact, int k, const Series& series, double* terms) const;
  void disturb(const Forcing& forcing, int k, const Disturbance& disturbance);
  void take(int k, Series& series) const;

  ModeSystems& systems_;
  const Model& model_;
  const Structure& structure_;
  const bool massless_;
  ModeSystemPtr system_;
  Besides besides_;                       // empty: none
  std::vector<std::size_t> bowls_;        // contacts on curved surfaces under forces that vary
  std::vector<FrictionSeries> friction_;  // for contacts with rate-dependent friction
  std::vector<double> x_, work_, known_u_, known_v_, mobility_, parts_;
  Eigen::MatrixXd terms_, sizes_;  // for a disturbed series; sizes_: |u_k| and the rounding carried into it
};

}  // namespace signorini
