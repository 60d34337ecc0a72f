// tangent_series.hpp: tangent motion in fixed contact states as a series, beside the series of the motion.
//
//   M wa_k + C wv_k + K w_k + sum ( n N_p,k + t T_p,k )
//     = P_p,k - M_p a_k - C_p v_k - K_p u_k - sum ( n_p N_k + t_p T_k )
//   row . (motion of the contact)_p,k = - row_p . (motion of the contact)_k          rows of the contact states
//   wv_k = (k+1)/s w_(k+1),   wa_k = (k+1)(k+2)/s^2 w_(k+2)
//
// This is the derivative of the motion's recurrence (motion/taylor.hpp): each level is one solve with the
// factors of the contact states. Levels beyond those of the motion have no right-hand side, since the omitted
// terms of the motion are below its rounding. The motion may be slow where its tangent is fast, so the
// tangent has its own convergence criterion.
#pragma once

#include "contact/friction.hpp"
#include "motion/state_systems.hpp"
#include "motion/taylor.hpp"
#include "sensitivity/forcing_rates.hpp"
#include "sensitivity/model_derivative.hpp"

namespace signorini::sensitivity {

/// Tangents of u and v at one instant, and of the anchors, by one parameter.
struct Tangent {
  Vector u, v;
  std::vector<double> anchors;
};

/// All quantities at one position of a series: values or tangents.
struct SeriesPoint {
  Vector u, v, a, forces, force_rates;
};
/// All quantities at position x of a series with these coefficients of u and of the forces.
[[nodiscard]] SeriesPoint point_at(const Eigen::MatrixXd& u, const Eigen::MatrixXd& forces, double scale,
                                   std::size_t degree, double x);
/// point_at() for several positions; only these degrees of freedom of u, v and a are computed, the others are
/// zero.
[[nodiscard]] std::vector<SeriesPoint> points_at(const Eigen::MatrixXd& u, const Eigen::MatrixXd& forces,
                                                 double scale, std::size_t degree,
                                                 const std::vector<double>& x,
                                                 const std::vector<Eigen::Index>& dofs);

/// Converts a series around t to one around t + scale x, whose half-width is the fraction `part`; the forcing is
/// expanded again.
void recentre(const motion::Series& series, const motion::Forcing& forcing, double x, double part,
              motion::Series& out);

class TangentSeries {
 public:
  /// Largest number of levels. A step of six radians leaves 6^40/40! = 2e-17.
  static constexpr int max_tangent_levels = 40;

  /// All arguments except size must outlive the object. size: size of the parameter. If a change of the
  /// parameter by its size moves the structure by less than eps of the displacement scale, the tangent counts
  /// as zero.
  TangentSeries(const Model& model, const linear::SystemMatrices& structure,
                const ModelDerivative& derivative, double size);

  /// Computes the levels needed to reach x, at least `levels` or those of the motion. Returns false if the
  /// series does not converge at x.
  [[nodiscard]] bool expand(const motion::StateSystem& system, const motion::Series& motion,
                            const ForcingRates& forcing, const Tangent& start, double x, int levels);
  /// Computes exactly `levels` levels.
  void expand_to(const motion::StateSystem& system, const motion::Series& motion, const ForcingRates& forcing,
                 const Tangent& start, int levels);

  /// point_at() of this series.
  [[nodiscard]] SeriesPoint at(double x) const;
  /// points_at() of this series.
  [[nodiscard]] std::vector<SeriesPoint> at(const std::vector<double>& x,
                                            const std::vector<Eigen::Index>& dofs) const;
  [[nodiscard]] const ForcingRatesSeries& forcing() const { return forcing_; }
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] long solves() const { return solves_; }
  /// Error of the last expand(): rounding of its terms, omitted terms at x, and friction at slip rates that its
  /// series do not follow; relative to the tangent at the beginning.
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
  [[nodiscard]] int late() const { return massless_ ? 2 : 0; }

  const Model& model_;
  const linear::SystemMatrices& structure_;
  const ModelDerivative& derivative_;
  bool massless_, matrices_, forms_;
  const motion::StateSystem* system_ = nullptr;
  const motion::Series* motion_ = nullptr;
  const Tangent* start_ = nullptr;
  ForcingRatesSeries forcing_;
  std::vector<std::pair<std::size_t, contact::FrictionTangent>> friction_;  // contacts with varying friction
  Eigen::MatrixXd u_, forces_;
  std::vector<double> x_, work_, known_u_, known_v_, scales_;
  Vector a_, v_;
  int levels_ = -1;
  double scale_ = 1.0, zero_limit_ = 0.0, error_ = 0.0;
  long solves_ = 0;
};

}  // namespace signorini::sensitivity
