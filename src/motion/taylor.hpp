// taylor.hpp: the motion in one mode as a Taylor series, exact for its linear system.
//
//   x(t + s z) = sum_k x_k z^k,   x_k = s^k/k! x^(k)(t)
//   M a_k + C v_k + K u_k + sum ( n N_k + t T_k ) = P_k,   rows of the mode
//   v_k = (k+1)/s u_(k+1),   a_k = (k+1)(k+2)/s^2 u_(k+2)
//
// Level k is one solve with the mode's system (motion/mode_system.hpp): its unknowns are a_k where there is
// mass, v_k of massless degrees of freedom with damping, u_k of those without, N_k and T_k. So u, v at an
// instant give consistent forces and accelerations (level 0), and then the whole series, whatever the mode:
// nonsymmetric by friction, singular by free motions, with massless parts or rigid sticking.
#pragma once

#include <functional>

#include "motion/friction_series.hpp"
#include "motion/mode_systems.hpp"
#include "motion/point.hpp"

namespace signorini {

/// Some roundings of all terms of all equations, irregular, the same from run to run: equal parts would leave
/// sums that cancel as they are, and make a zero of luck look like one of the equations.
struct Disturbance {
  const Series& motion;  ///< undisturbed: what the terms are

  static constexpr double most = 8.0;  ///< roundings: so that a result shows them above its own last digit
  /// +-(1/2 .. 1) most eps
  static double part(std::size_t i);
};

/// Expands one series at a time: what it needs besides the mode's system is its own.
class Taylor {
 public:
  explicit Taylor(ModeSystems& systems);

  /// The series about t from u and v (v of massless degrees of freedom is not read).
  void expand(const ModeSystemPtr& system, const Forcing& forcing, double t, const Vector& u, const Vector& v,
              int levels, double scale, Series& out, const Disturbance* disturbance = nullptr);
  /// The same in two parts: room for `levels`, then the levels up to the given one.
  void begin(const ModeSystemPtr& system, const Forcing& forcing, double t, const Vector& u, const Vector& v,
             int levels, double scale, Series& out, const Disturbance* disturbance = nullptr);
  void extend(const Forcing& forcing, int levels, Series& out, const Disturbance* disturbance = nullptr);

  /// What acts on the structure at a level besides the forcing, of series from here on; it must live as long.
  using Besides = std::function<void(int level, double* P)>;
  void act_besides(Besides besides) { besides_ = std::move(besides); }

  /// 1 over the mass of each degree of freedom alone, 0 where it has none.
  [[nodiscard]] const std::vector<double>& mobility() const { return mobility_; }
  /// The system of the last series: that of its mode, with friction at its slip rates.
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
  Besides besides_;                       // empty: nothing
  std::vector<std::size_t> bowls_;        // contacts on curved surfaces under forces that vary
  std::vector<FrictionSeries> friction_;  // of contacts whose friction depends on their slip rates
  std::vector<double> x_, work_, known_u_, known_v_, mobility_, parts_;
  Eigen::MatrixXd terms_, sizes_;  // of a disturbed series; sizes_: |u_k| and the rounding carried into it
};

}  // namespace signorini
