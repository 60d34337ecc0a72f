// taylor.hpp: the Taylor series of the motion in one contact state, exact for the linear system of the state.
//
//   x(t + s z) = sum_k x_k z^k,   x_k = s^k/k! x^(k)(t)
//   M a_k + C v_k + K u_k + sum ( n N_k + t T_k ) = P_k,   rows of the contact state
//   v_k = (k+1)/s u_(k+1),   a_k = (k+1)(k+2)/s^2 u_(k+2)
//
// Level k is one solve with the system of the state (motion/state_systems.hpp). Its unknowns are N_k and T_k, a_k of degrees
// of freedom with mass, v_k of massless ones with damping, and u_k of massless ones without damping. So u and v at an instant
// determine consistent forces and accelerations (level 0), and then the whole series. This is valid for all systems:
// nonsymmetric by friction, with unrestrained motions, with massless parts or rigid sticking.
#pragma once

#include <functional>
#include <optional>

#include "contact/friction.hpp"
#include "motion/forcing.hpp"
#include "motion/point.hpp"
#include "motion/state_systems.hpp"

namespace signorini::motion {

// Taylor coefficients of the motion.
//
//   u(t + s z) = sum_k u_k z^k,   N, T, g and ut likewise

/// Coefficients about t; column k: order k. The coefficients of v follow from those of u. Levels 0 to `levels` are computed.
struct Series {
  double t = 0.0, scale = 1.0;
  int levels = 0;
  /// n x (levels + 3); valid to order `levels`, and two orders further for dofs with mass.
  Eigen::MatrixXd u;
  ForceLayout layout;
  Eigen::MatrixXd forces;  ///< one row per place of `layout`; levels + 1 columns
  ForcingSeries forcing;   ///< levels + 3 coefficients
};

/// Taylor coefficient k of the gap g = g0 + n . u.
[[nodiscard]] inline double gap_coefficient(const Contact& contact, const Series& series, std::size_t k) {
  const double* u = series.u.data() + k * static_cast<std::size_t>(series.u.rows());
  return k == 0 ? contact.gap_at(u) : contact.normal.dot(u);
}
/// Taylor coefficient k of ut = t . u - s for contact number `index`.
[[nodiscard]] inline double ut_coefficient(const Contact& contact, std::size_t index, const Series& series,
                                           std::size_t k) {
  const double* u = series.u.data() + k * static_cast<std::size_t>(series.u.rows());
  return contact.tangent.dot(u) - series.forcing.surface[index * series.forcing.count + k];
}

/// Coefficient k of N, for a contact with the normal row N = kn g + cn g', N = -q or N = 0. It is known before level k is
/// solved if all degrees of freedom of the contact have mass.
[[nodiscard]] inline double normal_coefficient(const Contact& contact, std::size_t index, const Form& row,
                                               const Series& series, std::size_t k) {
  const double* v = series.u.data() + (k + 1) * static_cast<std::size_t>(series.u.rows());
  ContactMotion m;
  m.gap = gap_coefficient(contact, series, k);
  m.vn = static_cast<double>(k + 1) / series.scale * contact.normal.dot(v);
  m.applied_normal_force = series.forcing.applied_normal_force[index * series.forcing.count + k];
  return -(k == 0 ? row.value(m) : row.rate(m));
}

// Friction that depends on the slip rate or on N, along the Taylor series of the motion.
//
//   T_k + s sum_(j = 0..k) f_j N_(k-j) = 0       f_j: contact/friction.hpp
//
// f_0 is in the matrix of the system. The terms with f_1 to f_k are known at level k, because p'_k is known. For a massless
// sliding point (a shear element) p'_k is an unknown of level k:
//
//   T_k + s f_0 N_k + f'(s p'_0) N_0 p'_k = -s sum' f_j N_(k-j)     sum': without the part of p'_k in f_k
//
// p'_0 follows from T_0 (contact/friction.hpp). If the friction coefficient has its greatest value, or N_0 is zero, the point
// follows quasi-statically: its displacement is the unknown and the coefficient is constant.
//
// For friction that depends on N, F'(|N_0|) is in the matrix (contact/friction.hpp):
//   T_k + s F' N_k = s ( F_k - F' |N|_k )

class FrictionSeries {
 public:
  /// series: u_0 must be known, and u_1 of degrees of freedom with mass. s: sign of the slip rate; index: number of the
  /// contact; normal: its normal row.
  FrictionSeries(const Contact& contact, std::size_t index, int s, const Form& normal, const Series& series);

  [[nodiscard]] std::size_t contact() const { return index_; }
  /// Tangent row that enters the matrix of the system.
  [[nodiscard]] const Form& row() const { return row_; }
  /// Jump of a massless point if N has decreased so far that no slip rate near the present one balances the spring force;
  /// otherwise zero. Unit: length.
  [[nodiscard]] double jump() const { return jump_; }
  /// True if accelerations must decide whether the point follows quasi-statically: the friction coefficient has its greatest
  /// value, and the rate of N depends on accelerations through a dashpot. row() is then the row at max_rate().
  [[nodiscard]] bool is_ambiguous() const { return ambiguous_; }
  /// Makes the point follow quasi-statically; called if the accelerations require it.
  void follow_quasi_statically();
  /// Rate along the slip direction, from a series in which the point follows quasi-statically.
  [[nodiscard]] double rate_in(const Series& series) const { return sign_ * slip_rate(0, series); }
  /// Slip rate from which the friction coefficient is treated as its greatest value: contact::saturation_rate().
  [[nodiscard]] double max_rate() const;
  /// Known part of the row at level k; must be called for k = 0, 1, 2, ... in this order.
  [[nodiscard]] double known(int k, const Series& series);
  /// contact::FrictionRecursion::reach() at a body that slips with friction by slip rate; else x.
  [[nodiscard]] double reach(std::size_t degree, double x) const;

 private:
  void begin_load_dependent(const Form& normal, const Series& series);
  void begin_massless(int s, const Form& normal, const Series& series);
  [[nodiscard]] double slip_rate(std::size_t k, const Series& series) const;

  const Contact* contact_;
  std::size_t index_;
  int sign_;
  Form row_;
  double jump_ = 0.0;
  bool constant_ = false;  // the friction coefficient is constant
  bool ambiguous_ = false;
  contact::FrictionRecursion friction_;
  std::optional<contact::LimitSeries> limit_;  // for friction that depends on N
};

/// Perturbations of all equations by a few rounding errors of their terms, irregular but reproducible. Equal perturbations
/// would leave cancelling sums unchanged, so that an accidental zero would look like an exact zero.
struct DataPerturbation {
  const Series& motion;  ///< unperturbed series, which gives the magnitudes of the terms

  /// Largest perturbation in units of eps. Chosen so that it changes results by more than their last digit.
  static constexpr double max_roundings = 8.0;
  /// Relative perturbation number i: of either sign, magnitude between 1/2 and 1 times max_roundings eps.
  static double fraction(std::size_t i);
};

/// Expands one series at a time. Apart from `systems` an object uses only its own memory.
class Taylor {
 public:
  explicit Taylor(StateSystems& systems);

  /// Expands the series about t from u and v; v of massless degrees of freedom is ignored.
  void expand(const StateSystemPtr& system, const Forcing& forcing, double t, const Vector& u,
              const Vector& v, int levels, double scale, Series& out,
              const DataPerturbation* disturbance = nullptr);
  /// expand() in two steps: begin() allocates memory for `levels` levels, extend() computes all levels up to the given one.
  void begin(const StateSystemPtr& system, const Forcing& forcing, double t, const Vector& u, const Vector& v,
             int levels, double scale, Series& out, const DataPerturbation* disturbance = nullptr);
  void extend(const Forcing& forcing, int levels, Series& out, const DataPerturbation* disturbance = nullptr);

  /// Function that adds coefficients of additional loads to P at a level. It is used for all later series, so it must stay
  /// callable until the last of them is computed.
  using AdditionalLoads = std::function<void(int level, double* P)>;
  void set_additional_loads(AdditionalLoads besides) { additional_loads_ = std::move(besides); }

  /// 1 / M_ii for each degree of freedom i; 0 for massless ones.
  [[nodiscard]] const std::vector<double>& mobility() const { return mobility_; }
  /// System of the last series: that of its contact state, with friction at the slip rates of the series.
  [[nodiscard]] const StateSystemPtr& system() const { return system_; }
  [[nodiscard]] bool massless() const { return massless_; }
  /// Largest place <= x up to which the friction of the last series, cut after `degree`, is accurate at its slip rates.
  [[nodiscard]] double friction_reach(std::size_t degree, double x) const;
  /// Sums of the magnitudes of the terms of each equation in the last perturbed series; column k: level k. Rows: the n
  /// degrees of freedom, then the rows of all contacts.
  [[nodiscard]] const Eigen::MatrixXd& terms() const { return terms_; }

 private:
  void start_friction(const Forcing& forcing, Series& series);
  void resolve_ambiguities(const Forcing& forcing, Series& series);
  [[nodiscard]] StateSystemPtr system_with_friction() const;
  void add_restoring_forces(int k, const Series& series);
  [[nodiscard]] double prescribed_value(const linear::PrescribedDof& pinned, int k,
                                        const Series& series) const;
  void known_row_parts(std::size_t contact, int k, const Series& series, double& normal,
                       double& tangent) const;
  void level(const Forcing& forcing, int k, Series& series, const DataPerturbation* disturbance);
  template <std::size_t fixed_n, std::size_t fixed_size>
  void level_dense(const Forcing& forcing, int k, Series& series);
  void level_any(const Forcing& forcing, int k, Series& series, const DataPerturbation* disturbance);
  void set_known_motion(int k, const Series& series);
  void measure_equations(const Forcing& forcing, int k, const Series& series, double* terms) const;
  void measure_forces(std::size_t contact, int k, const Series& series, double* terms) const;
  void measure_rows(std::size_t contact, int k, const Series& series, double* terms) const;
  void perturb(const Forcing& forcing, int k, const DataPerturbation& disturbance);
  void take(int k, Series& series) const;

  StateSystems& systems_;
  const Model& model_;
  const linear::SystemMatrices& structure_;
  const bool massless_;
  StateSystemPtr system_;
  AdditionalLoads additional_loads_;          // empty: no additional loads
  std::vector<std::size_t> curved_contacts_;  // contacts on curved surfaces under varying normal forces
  std::vector<FrictionSeries> friction_;      // one entry per contact that slips with varying friction
  std::vector<double> x_, work_, known_u_, known_v_, mobility_, parts_;
  Eigen::MatrixXd terms_, sizes_;  // for perturbed series; sizes_: |u_k| and carried rounding errors
};

}  // namespace signorini::motion
