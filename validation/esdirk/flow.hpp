// flow.hpp: a mode as an ordinary differential equation, and its condensed linear systems.
//
//   u' = v,   M v' = P(t) - C v - K u - sum ( n N + t T ),   N, T by the rows of the mode
//   (I - g J) x = b:   (M + g C + g^2 K) x_v + n g dN + t g dT = M b_v - g K b_u,   x_u = b_u + g x_v
//
// Both are one solve with the matrix of the structure and two rows a contact, the one behind all engines
// (linear/system_matrix.hpp). Vectors y = [u, v] of length 2 n; degrees of freedom without mass are not
// treated.
#pragma once

#include <optional>

#include "contact/friction.hpp"
#include "linear/system_matrix.hpp"
#include "motion/forcing.hpp"

namespace signorini::esdirk {

class ModeFlow {
 public:
  ModeFlow(const Model& model, const linear::SystemMatrices& structure);

  /// Puts a mode and the pieces of the loads just after t in force.
  void start(const contact::ContactStates& states, double t);
  /// dy = f(t, y); order k > 0: the k-th derivative of f along a motion whose k-th derivative is y (not for
  /// Stribeck's friction).
  void derivative(double t, int order, const double* y, double* dy);
  /// Tangents of Stribeck's friction at y.
  void linearise(double t, const double* y);
  [[nodiscard]] bool factor(double g);
  void solve(const double* b, double* x);

  /// Weights of the error norm, 1 / (rtol (|y| + scale)), the same for every integrator.
  void set_tolerance(double rtol) { rtol_ = rtol; }
  void weights(const double* y, double* w) const;
  /// Root mean square of the difference of two states, each entry relative to its scale.
  [[nodiscard]] double distance(const double* y, const Vector& u, const Vector& v) const;
  /// N (side 0) or T (side 1) of contact k in the last derivative() of order 0.
  [[nodiscard]] double force(std::size_t k, int side) const {
    return rhs_[static_cast<std::size_t>(n_) + 2 * k + static_cast<std::size_t>(side)];
  }
  /// Value of a form on contact k in the state y.
  [[nodiscard]] double value(const Form& form, std::size_t k, double t, const double* y);

  [[nodiscard]] int size() const { return n_; }
  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] const motion::Forcing& forcing() const { return *forcing_; }
  [[nodiscard]] bool linear() const { return linear_; }
  [[nodiscard]] const std::vector<Rows>& rows() const { return rows_; }
  /// Motion of contact k without forces and accelerations; order > 0: its derivatives.
  [[nodiscard]] ContactMotion motion(std::size_t k, double t, int order, const double* u,
                                     const double* v) const;

  struct Count {
    long derivatives = 0, solves = 0, factorisations = 0;
  } count;

 private:
  const Model& model_;
  const linear::SystemMatrices& structure_;
  int n_;
  linear::SystemMatrix mass_, implicit_;
  contact::ContactStates states_;
  std::vector<Rows> rows_, tangents_;
  std::vector<double> rhs_, work_, scale_;
  std::optional<motion::Forcing> forcing_;
  double g_ = 0.0, rtol_ = 0.0;
  bool linear_ = true, fresh_ = true;
};

/// f of a slipping contact under Stribeck's law, in the tangent row T + s f N = 0, and that row's tangent.
[[nodiscard]] Form stribeck_row(const Contact& contact, State state, double vt);
[[nodiscard]] Form stribeck_tangent(const Contact& contact, State state, double vt, double N);

}  // namespace signorini::esdirk
