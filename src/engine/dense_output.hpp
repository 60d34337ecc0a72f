// dense_output.hpp: the motion on the last step of an engine, and further data about this step.
//
//   u(t), v(t), forces(t)   begin <= t <= end       evaluate, evaluate_watched, interpolate; accelerate adds a(t)
//   int powers dt                                   integrate
//   |M a + C v + K u + n N + t T - P|               residual, at the end of the step
//
// facts() returns the data of the whole step (turning points, series, phase angle, fast modes). Pointers in StepFacts are valid
// until the engine's next step.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <span>

#include "engine/events/turning_points.hpp"
#include "motion/point.hpp"
#include "motion/taylor.hpp"

namespace signorini::engine {

// Bounds on the contribution of the fast part of a motion to any output.
//
//   |form . u| <= r |u|_M,   r^2 = form^T M^-1 form (form_norm),   |u|_M^2 = u^T M u   (Cauchy, Schwarz)
//
// If the modes are known, |u|_M of all modes faster than a given rate is the square root of the sum of their squared
// amplitudes. So one sum bounds the outputs of all forms. A sum over all modes has a rounding error of a few eps r |u|_M for
// every form, even for a stress at a clamped end.

/// Bounds on |u|_M, |v|_M and |a|_M in a step. Units: length sqrt(mass) for u, divided by time for v and by time^2 for a.
struct FastModeBound {
  double u = 0.0, v = 0.0, a = 0.0;
  Eigen::VectorXd forces;  ///< bounds of all contact forces, in the order of the model's layout
};

/// The motion on the last step as a power series. The step ends at the time series->t + series->scale x.
struct Expansion {
  const motion::Series* series = nullptr;  ///< null if the engine has no series
  std::size_t degree = 0;                  ///< u, v, a and forces are complete up to this degree
  double x = 0.0;                          ///< value of the series variable at the end of the step
  /// Equations of the contact states. Coefficients of friction are those at the beginning of the series.
  const motion::StateSystem* system = nullptr;
};

/// Bounds on the contribution of fast modes to the last step. Only engines that compute in modes provide these bounds.
class FastModes {
 public:
  virtual ~FastModes() = default;
  /// Bounds on the sum of all modes faster than omega (rad per time). nullopt: no bound is known, or the motion has a fast part
  /// that does not oscillate.
  [[nodiscard]] virtual std::optional<FastModeBound> fast_mode_bound(double omega) const = 0;
  /// Sums of the magnitudes of the terms of u, v, a and forces on the step, fast modes included. Rounding
  /// errors are relative to these sums.
  [[nodiscard]] virtual FastModeBound term_sizes() const = 0;
  /// Greatest value of form . u over all u with |u|_M = 1.
  [[nodiscard]] virtual double form_norm(const Combination& form) const = 0;
};

struct StepFacts {
  /// Ascending times inside the step at which N, T, g or ut of a contact has a local extreme beyond all earlier values.
  std::span<const double> turning_points = {};
  /// Contact, quantity and time of each turning point, unordered. Null if evaluate_watched() is not faster for one contact than
  /// for all contacts.
  const std::vector<events::TurningPointDetector::TurningPoint>* contact_turning_points = nullptr;
  Expansion expansion = {};
  /// Factor by which the rounding errors of sums over modes exceed those of orthogonal modes: largest |x| |y| of all modes,
  /// where x and y are the right and left eigenvectors with y . x = 1. Large if large terms cancel. 1 if the motion is not a
  /// sum over modes.
  double eigenvector_condition = 1.0;
  /// Largest phase angle of u, v, a and forces on the step in rad, without the phase angle of the forcing: frequency times step
  /// length, or n pi for polynomials of degree n. Infinite if unknown: callers then use the frequencies of the model.
  double phase_angle = std::numeric_limits<double>::infinity();
  const FastModes* fast_modes = nullptr;  ///< null if the engine does not compute in modes
};

class DenseOutput {
 public:
  virtual ~DenseOutput() = default;
  /// Evaluates u, v and forces at begin <= t <= end.
  virtual void evaluate(double t, motion::Point& point) = 0;
  /// Evaluates only the watched entries of u and v (those of contacts and EngineParts::watched); other entries may be NaN. If
  /// `contact` is set, only the entries of this contact are needed; callers set it only if StepFacts::contact_turning_points is
  /// not null.
  virtual void evaluate_watched(double t, std::optional<std::size_t> /*contact*/, motion::Point& point) {
    evaluate(t, point);
  }
  /// Adds the accelerations to a point that was evaluated at time t, if the point has none.
  virtual void accelerate(double /*t*/, motion::Point& /*point*/) {}
  /// Evaluates u, v, a and forces like evaluate() and accelerate(), by the fastest method of the engine: engines with fixed
  /// steps interpolate between the ends of the step.
  virtual void interpolate(double t, motion::Point& point) {
    evaluate(t, point);
    accelerate(t, point);
  }
  /// Adds the integrals of all powers over the part [from, to] of the step to `works`.
  virtual void integrate(double from, double to, motion::WorkIntegrals& works) = 0;
  /// Largest magnitude of an entry of the residual of the equation of motion at the end of the step, as a force.
  [[nodiscard]] virtual double residual() = 0;
  [[nodiscard]] virtual StepFacts facts() const = 0;
};

}  // namespace signorini::engine
