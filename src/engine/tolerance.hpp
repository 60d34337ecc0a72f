// tolerance.hpp: admissible errors of the quantities of a scene.
//
//   tol(x) = rtol |x| + atol,   atol = rtol * scale of the scene where the scene gives none
#pragma once

#include "contact/law.hpp"
#include "signorini/model.hpp"

namespace signorini::engine {

/// All tolerances except rtol are absolute, in the units of the scene; angles in radians.
struct Tolerance {
  double rtol = 0.0;
  double displacement = 0.0, rotation = 0.0, velocity = 0.0, angular_velocity = 0.0;
  double force = 0.0;

  /// Rigid contacts without a capture_velocity come to rest if their rebound is slower than this.
  [[nodiscard]] double capture_velocity() const { return velocity; }
};

/// Tolerances given in [run], otherwise from the scales of the model.
[[nodiscard]] Tolerance tolerance_of(const Model& model, const RunSpec& run);

/// Tolerance of a form's value, from those of the motion's entries.
[[nodiscard]] double tolerance(const Form& form, const ContactMotion& motion, const Tolerance& tolerance);
[[nodiscard]] double tolerance(const GuardForm& guard, const ContactMotion& motion,
                               const Tolerance& tolerance);

}  // namespace signorini::engine
