// taylor.hpp: the motion in one contact state as a Taylor series, exact for its linear system.
//
//   x(t + s z) = sum_k x_k z^k,   x_k = s^k/k! x^(k)(t)
//   M a_k + C v_k + K u_k + sum ( n N_k + t T_k ) = P_k,   rows of the contact state
//   v_k = (k+1)/s u_(k+1),   a_k = (k+1)(k+2)/s^2 u_(k+2)
//
// Level k is one solve with the state's system (motion/state_systems.hpp): its unknowns are a_k of degrees of
// freedom with mass, v_k of massless degrees of freedom with damping, u_k of those without, N_k and T_k. So u
// and v at an instant give consistent forces and accelerations (level 0), and then the whole series. This
// holds for every kind of system: nonsymmetric by friction, singular by free motions, with massless parts or
// rigid sticking.
#pragma once

#include <functional>
#include <optional>

#include "contact/friction.hpp"
#include "motion/forcing.hpp"
#include "motion/point.hpp"
#include "motion/state_systems.hpp"

namespace signorini::motion {

// Coefficients of the motion's Taylor series.
//
//   u(t + s z) = sum_k u_k z^k,   N, T, g and ut likewise

/// Coefficients about t, column k: order k. v follows from u; levels 0 .. `levels`.
struct Series {
  double t = 0.0, scale = 1.0;
  int levels = 0;
  Eigen::MatrixXd u;  ///< n x (levels + 3); complete to order `levels`, beyond only with mass
  ForceLayout layout;
  Eigen::MatrixXd forces;  ///< all contacts x (levels + 1)
  ForcingSeries forcing;   ///< levels + 3 coefficients
};

/// Coefficient k of g = g0 + n . u, and of ut = t . u - s at contact number `index`.
[[nodiscard]] inline double gap_coefficient(const Contact& contact, const Series& series, std::size_t k) {
  const double* u = series.u.data() + k * static_cast<std::size_t>(series.u.rows());
  return k == 0 ? contact.gap_at(u) : contact.normal.dot(u);
}
[[nodiscard]] inline double ut_coefficient(const Contact& contact, std::size_t index, const Series& series,
                                           std::size_t k) {
  const double* u = series.u.data() + k * static_cast<std::size_t>(series.u.rows());
  return contact.tangent.dot(u) - series.forcing.surface[index * series.forcing.count + k];
}

/// Coefficient k of N of a contact with the normal row N = kn g + cn g', N = -q or N = 0. If its degrees of
/// freedom have mass, it is known before level k is solved.
[[nodiscard]] inline double normal_coefficient(const Contact& contact, std::size_t index, const Form& row,
                                               const Series& series, std::size_t k) {
  const double* v = series.u.data() + (k + 1) * static_cast<std::size_t>(series.u.rows());
  ContactMotion m;
  m.gap = gap_coefficient(contact, series, k);
  m.vn = static_cast<double>(k + 1) / series.scale * contact.normal.dot(v);
  m.applied_normal_force = series.forcing.applied_normal_force[index * series.forcing.count + k];
  return -(k == 0 ? row.value(m) : row.rate(m));
}

// Friction that depends on the slip rate or on N, along a series of the motion.
//
//   T_k + s sum_(j = 0..k) f_j N_(k-j) = 0       f_j: contact/friction.hpp
//
// f_0 is in the matrix of the system; the terms with f_1 to f_k are known at level k, since p'_k is. A
// sliding point without mass (a shear element) has p'_k as an unknown of level k:
//
//   T_k + s f_0 N_k + f'(s p'_0) N_0 p'_k = -s sum' f_j N_(k-j)     sum': without the part of p'_k in f_k
//
// and p'_0 follows from T_0 (contact/friction.hpp). If the coefficient of friction is at its greatest value,
// or N_0 is zero, the point follows quasi-statically: its displacement is the unknown, and the coefficient is
// constant.
//
// For friction that depends on N, F'(|N_0|) is in the matrix (contact/friction.hpp):
//   T_k + s F' N_k = s ( F_k - F' |N|_k )

class FrictionSeries {
 public:
  /// Begins a series whose u_0 and u_1 are known, u_1 for degrees of freedom with mass. s: direction of slip; contact
  /// number `index`; normal: its row.
  FrictionSeries(const Contact& contact, std::size_t index, int s, const Form& normal, const Series& series);

  [[nodiscard]] std::size_t contact() const { return index_; }
  /// The tangent row in the matrix.
  [[nodiscard]] const Form& row() const { return row_; }
  /// Jump of a point without mass, if N has decreased so far that friction balances the spring at no rate
  /// near the present one; else zero. Unit: length.
  [[nodiscard]] double jump() const { return jump_; }
  /// True if accelerations must decide whether the point follows quasi-statically: the coefficient of
  /// friction is at its greatest value, and the rate of N depends on accelerations through a dashpot. row()
  /// then is that of max_rate().
  [[nodiscard]] bool is_ambiguous() const { return ambiguous_; }
  /// Lets the point follow quasi-statically, after the accelerations have decided so.
  void follow_quasi_statically();
  /// Rate along the slip in a series in which the point follows quasi-statically.
  [[nodiscard]] double rate_in(const Series& series) const { return sign_ * slip_rate(0, series); }
  /// Rate at which the coefficient of friction counts as its greatest value: contact::saturation_rate().
  [[nodiscard]] double max_rate() const;
  /// Known part of the row at level k; must be called for k = 0, 1, 2, ... in this order.
  [[nodiscard]] double known(int k, const Series& series);
  /// contact::FrictionRecursion::reach() at a body that slips with friction by slip rate; else x.
  [[nodiscard]] double reach(std::size_t degree, double x) const;

 private:
  void begin_by_force(const Form& normal, const Series& series);
  void begin_massless(int s, const Form& normal, const Series& series);
  [[nodiscard]] double slip_rate(std::size_t k, const Series& series) const;

  const Contact* contact_;
  std::size_t index_;
  int sign_;
  Form row_;
  double jump_ = 0.0;
  bool constant_ = false;  // friction's coefficient is constant
  bool ambiguous_ = false;
  contact::FrictionRecursion friction_;
  std::optional<contact::LimitSeries> limit_;  // for friction that depends on N
};

/// Perturbations of all equations by some roundings of their terms, irregular but reproducible. Equal
/// perturbations would leave cancelling sums unchanged, so that an accidental zero would look like a zero of
/// the equations.
struct DataPerturbation {
  const Series& motion;  ///< unperturbed series, from which the terms are computed

  /// Greatest perturbation in units of eps; chosen so that results show it above their last digit.
  static constexpr double max_roundings = 8.0;
  /// Relative perturbation number i: between 1/2 and 1 times max_roundings eps in magnitude, of either sign.
  static double fraction(std::size_t i);
};

/// Expands one series at a time; apart from the state's system it uses only its own memory.
class Taylor {
 public:
  explicit Taylor(StateSystems& systems);

  /// Expands the series about t from u and v (v of massless degrees of freedom is not read).
  void expand(const StateSystemPtr& system, const Forcing& forcing, double t, const Vector& u,
              const Vector& v, int levels, double scale, Series& out,
              const DataPerturbation* disturbance = nullptr);
  /// Same in two parts: begin() allocates memory for `levels`, extend() computes the levels up to the given
  /// one.
  void begin(const StateSystemPtr& system, const Forcing& forcing, double t, const Vector& u, const Vector& v,
             int levels, double scale, Series& out, const DataPerturbation* disturbance = nullptr);
  void extend(const Forcing& forcing, int levels, Series& out, const DataPerturbation* disturbance = nullptr);

  /// Additional loads on the structure at a level, for all later series; the function must outlive them.
  using AdditionalLoads = std::function<void(int level, double* P)>;
  void set_additional_loads(AdditionalLoads besides) { additional_loads_ = std::move(besides); }

  /// 1 / M_ii for each degree of freedom i; 0 without mass.
  [[nodiscard]] const std::vector<double>& mobility() const { return mobility_; }
  /// The system of the last series: that of its contact state, with friction at its slip rates.
  [[nodiscard]] const StateSystemPtr& system() const { return system_; }
  [[nodiscard]] bool massless() const { return massless_; }
  /// The greatest place <= x up to which friction follows the slip rate of the last series, cut after `degree`.
  [[nodiscard]] double friction_reach(std::size_t degree, double x) const;
  /// Sums of the magnitudes of the terms of each equation, level k of the last perturbed series in column k.
  /// Rows: the n degrees of freedom, then the rows of all contacts.
  [[nodiscard]] const Eigen::MatrixXd& terms() const { return terms_; }

 private:
  void start_friction(const Forcing& forcing, Series& series);
  void resolve_ambiguities(const Forcing& forcing, Series& series);
  [[nodiscard]] StateSystemPtr at_friction() const;
  void add_restoring_forces(int k, const Series& series);
  [[nodiscard]] double prescribed_value(const linear::PrescribedDof& pinned, int k,
                                        const Series& series) const;
  void known_of_rows(std::size_t contact, int k, const Series& series, double& normal, double& tangent) const;
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
  AdditionalLoads additional_loads_;          // empty: none
  std::vector<std::size_t> curved_contacts_;  // contacts on curved surfaces under forces that vary
  std::vector<FrictionSeries> friction_;      // for contacts that slip with varying friction
  std::vector<double> x_, work_, known_u_, known_v_, mobility_, parts_;
  Eigen::MatrixXd terms_, sizes_;  // for a perturbed series; sizes_: |u_k| and the rounding carried into it
};

}  // namespace signorini::motion
