#include "engine/tolerance.hpp"

#include <cmath>

namespace signorini::engine {

Tolerance tolerance_of(const Model& model, const RunSpec& run) {
  const Scales& scale = model.scales;
  Tolerance t;
  t.rtol = run.rtol;
  t.displacement = run.atol.displacement.value_or(run.rtol * scale.displacement);
  t.velocity = run.atol.velocity.value_or(run.rtol * scale.velocity);
  t.force = run.atol.force.value_or(run.rtol * scale.force);
  // The scene gives no tolerance for angles: the tolerance for lengths is converted by the ratio of the scales.
  t.rotation = t.displacement * scale.rotation / scale.displacement;
  t.angular_velocity = t.velocity * scale.angular_velocity / scale.velocity;
  return t;
}

double tolerance(const Form& form, const ContactMotion& m, const Tolerance& t) {
  const auto part = [&](double factor, double value, double atol) {
    return factor == 0.0 ? 0.0 : std::abs(factor) * (t.rtol * std::abs(value) + atol);
  };
  // Tolerance of the rate of the friction limit, F' = dF/dN kn g', from the tolerance of g'. A slider, whose N is given, has
  // vn = 0.
  const double of_limit_rate = m.vn == 0.0 ? 0.0 : std::abs(m.limit_rate / m.vn) * t.velocity;
  return part(form.N, m.N, t.force) + part(form.T, m.T, t.force) + part(form.gap, m.gap, t.displacement) +
         part(form.ut, m.ut, t.displacement) + part(form.vn, m.vn, t.velocity) +
         part(form.vt, m.vt, t.velocity) + part(form.limit, m.limit, t.force) +
         part(form.limit_rate, m.limit_rate, of_limit_rate);
}

double tolerance(const GuardForm& guard, const ContactMotion& m, const Tolerance& t) {
  return guard.error([&](const Form& form) { return tolerance(form, m, t); },
                     [&](const Form& form) { return std::abs(form.value(m)); });
}

}  // namespace signorini::engine
