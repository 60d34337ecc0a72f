#include "engine/tolerance.hpp"

#include <cmath>

namespace signorini {

Settings settings_for(const Model& model, const RunSpec& run) {
  Settings s;
  const Scales& scale = model.scales;
  s.rtol = run.rtol;
  s.atol_displacement = run.atol.displacement.value_or(run.rtol * scale.displacement);
  s.atol_velocity = run.atol.velocity.value_or(run.rtol * scale.velocity);
  s.atol_force = run.atol.force.value_or(run.rtol * scale.force);
  s.capture_velocity = s.atol_velocity;
  // A scene gives one tolerance for lengths; the ratio of the scales turns it into one for angles.
  s.atol_rotation = s.atol_displacement * scale.rotation / scale.displacement;
  s.atol_angular_velocity = s.atol_velocity * scale.angular_velocity / scale.velocity;
  return s;
}

double tolerance(const Form& form, const ContactMotion& m, const Settings& s) {
  const auto part = [&](double factor, double value, double atol) {
    return factor == 0.0 ? 0.0 : std::abs(factor) * (s.rtol * std::abs(value) + atol);
  };
  return part(form.N, m.N, s.atol_force) + part(form.T, m.T, s.atol_force) +
         part(form.gap, m.gap, s.atol_displacement) + part(form.ut, m.ut, s.atol_displacement) +
         part(form.vn, m.vn, s.atol_velocity) + part(form.vt, m.vt, s.atol_velocity);
}

}  // namespace signorini
