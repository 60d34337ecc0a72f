// tangent_series.hpp: tangent motion in fixed contact states as a Taylor series, together with the series of the motion.
//
//   M wa_k + C wv_k + K w_k + sum ( n N_p,k + t T_p,k )
//     = P_p,k - M_p a_k - C_p v_k - K_p u_k - sum ( n_p N_k + t_p T_k )
//   row . (motion of the contact)_p,k = - row_p . (motion of the contact)_k          rows of the contact states
//   wv_k = (k+1)/s w_(k+1),   wa_k = (k+1)(k+2)/s^2 w_(k+2)
//
// This is the derivative of the recurrence of the motion (motion/taylor.hpp). Each level is one solve with the factors of the
// contact states. Levels beyond those of the motion have no source terms, because the omitted terms of the motion are below
// its rounding error. A tangent may vary faster than the motion, so it has a separate convergence criterion.
#pragma once

#include "contact/friction.hpp"
#include "motion/state_systems.hpp"
#include "motion/taylor.hpp"
#include "sensitivity/forcing_rates.hpp"
#include "sensitivity/model_derivative.hpp"

namespace signorini::sensitivity {

/// Tangents of u, v and the anchors at one instant, with respect to one parameter.
struct Tangent {
  Vector u, v;
  std::vector<double> anchors;
};

/// All quantities at one position of a series: values, or their tangents.
struct SeriesPoint {
  Vector u, v, a, forces, force_rates;
};
/// Evaluates, at position x, the series with these coefficients of u and of the forces.
[[nodiscard]] SeriesPoint point_at(const Eigen::MatrixXd& u, const Eigen::MatrixXd& forces, double scale,
                                   std::size_t degree, double x);
/// point_at() for several positions. For u and a only the listed degrees of freedom are computed; all others are zero.
[[nodiscard]] std::vector<SeriesPoint> points_at(const Eigen::MatrixXd& u, const Eigen::MatrixXd& forces,
                                                 double scale, std::size_t degree,
                                                 const std::vector<double>& x,
                                                 const std::vector<Eigen::Index>& dofs);

/// Converts a series about t to one about t + scale x whose scale is the fraction `part` of the old one. The forcing is
/// expanded again.
void recentre(const motion::Series& series, const motion::Forcing& forcing, double x, double part,
              motion::Series& out);

class TangentSeries {
 public:
  /// Largest number of levels. A step of six radians then has the remainder 6^40/40! = 2e-17.
  static constexpr int max_tangent_levels = 40;

  /// All arguments except `size` must outlive the object. size: size of the parameter. If changing the parameter by its size
  /// moves the structure by less than eps of the displacement scale, the tangent is treated as zero.
  TangentSeries(const Model& model, const linear::SystemMatrices& structure,
                const ModelDerivative& derivative, double size);

  /// Computes as many levels as are needed at x, at least `levels` or the levels of the motion. Returns false if the series
  /// does not converge at x.
  [[nodiscard]] bool expand(const motion::StateSystem& system, const motion::Series& motion,
                            const ForcingRates& forcing, const Tangent& start, double x, int levels);
  /// Computes exactly the levels 0 to `levels`.
  void expand_to(const motion::StateSystem& system, const motion::Series& motion, const ForcingRates& forcing,
                 const Tangent& start, int levels);

  /// point_at() for this series.
  [[nodiscard]] SeriesPoint at(double x) const;
  /// points_at() for this series.
  [[nodiscard]] std::vector<SeriesPoint> at(const std::vector<double>& x,
                                            const std::vector<Eigen::Index>& dofs) const;
  [[nodiscard]] const ForcingDerivatives& forcing() const { return forcing_; }
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] long solves() const { return solves_; }
  /// Error of the last expand(): rounding errors of the terms, omitted terms at x, and friction at slip rates that the series
  /// do not represent; relative to the tangent at the beginning.
  [[nodiscard]] double error() const { return error_; }

 private:
  void begin(const motion::StateSystem& system, const motion::Series& motion, const ForcingRates& forcing,
             const Tangent& start);
  void level(int k);
  void add_sources(int k);
  void add_rows(int k);
  void add_friction(int k);
  [[nodiscard]] double size_of(const Eigen::Ref<const Vector>& x) const;
  [[nodiscard]] std::pair<double, double> slip_rate(std::size_t contact, int k) const;
  [[nodiscard]] double friction_error(double x, double size);
  /// Number of the last levels for which the coefficients of massless degrees of freedom are not yet known.
  [[nodiscard]] int late() const { return massless_ ? 2 : 0; }

  const Model& model_;
  const linear::SystemMatrices& structure_;
  const ModelDerivative& derivative_;
  bool massless_, changes_matrices_,
      forms_;  // changes_matrices_, forms_: the parameter changes M, C or K; n or t of a contact
  const motion::StateSystem* system_ = nullptr;
  const motion::Series* motion_ = nullptr;
  const Tangent* start_ = nullptr;
  ForcingDerivatives forcing_;
  // One entry per contact with varying friction.
  std::vector<std::pair<std::size_t, contact::FrictionTangent>> friction_;
  Eigen::MatrixXd u_, forces_;
  std::vector<double> x_, work_, known_u_, known_v_, scales_;
  int levels_ = -1;
  double scale_ = 1.0, zero_limit_ = 0.0, error_ = 0.0;
  long solves_ = 0;
};

}  // namespace signorini::sensitivity
