// tolerance.hpp: admissible errors of the quantities of a scene.
//
//   tol(x) = rtol |x| + atol,   atol = rtol * (scale of the quantity) if the scene gives no atol
#pragma once

#include "contact/law.hpp"
#include "signorini/model.hpp"

namespace signorini::engine {

/// All tolerances except rtol are absolute, in model units (model/internal_units.hpp); angles in radians.
struct Tolerance {
  double rtol = 0.0;
  double displacement = 0.0, rotation = 0.0, velocity = 0.0, angular_velocity = 0.0;
  double force = 0.0;

  /// Rebound speed below which a rigid contact without a given capture_velocity stays closed.
  [[nodiscard]] double capture_velocity() const { return velocity; }
};

/// Tolerances given in [run]. A tolerance that is not given is rtol times the model's scale of the quantity.
[[nodiscard]] Tolerance tolerance_of(const Model& model, const RunSpec& run);

/// Tolerance of the value of a form: the tolerances of the entries of the motion, weighted with the form's factors.
[[nodiscard]] double tolerance(const Form& form, const ContactMotion& motion, const Tolerance& tolerance);
[[nodiscard]] double tolerance(const GuardForm& guard, const ContactMotion& motion,
                               const Tolerance& tolerance);

}  // namespace signorini::engine
