#include "sensitivity/tangent_impact.hpp"

#include "contact/friction.hpp"
#include "decide/impact.hpp"

namespace signorini {

ImpactRates impact_rates(ModeSystems& systems, const ModelDerivative& derivative, Mode mode,
                         const Decision& after, const Vector& v, const Vector& Dv,
                         const std::vector<double>& surface) {
  const Model& model = systems.model();
  ImpactRates result;
  mode = mode_of_impact(model, std::move(mode), after.impulses);
  const ModeSystemPtr system = systems.of(mode);
  if (!system) return result;
  const Unknowns& at = system->unknowns();
  std::vector<double> x(at.size(), 0.0), work(at.size());
  Eigen::Map<Vector> momentum(x.data(), model.size());
  const Vector jump = after.v - v;
  if (derivative.mass.nonZeros() > 0) momentum -= derivative.mass * jump;
  for (std::size_t c = 0; c < mode.size(); ++c) {
    const Impulse& impulse = after.impulses[c];
    if (!(impulse.normal > 0.0)) continue;
    const Contact& contact = model.contacts[c];
    const ContactRates& rates = derivative.contacts[c];
    rates.normal.add_to(momentum, impulse.normal);
    rates.tangent.add_to(momentum, impulse.tangent);
    const double vn = contact.normal.dot(v);
    const double Dvn = contact.normal.dot(Dv) + rates.normal.dot(v);
    double rebound = 0.0;
    if (!impulse.rests && vn < 0.0) rebound = -contact.restitution * Dvn - rates.restitution * vn;
    x[at.normal(c)] = rebound - rates.normal.dot(after.v) - contact.normal.dot(Dv);
    if (mode[c].state == State::stick)
      x[at.tangent(c)] = surface[c] - rates.tangent.dot(after.v) - contact.tangent.dot(Dv);
    else if (const int s = slip_sign(mode[c].state); s != 0)
      x[at.tangent(c)] = s * rates.friction.kinetic * impulse.normal;
  }
  system->solve(x.data(), work.data());
  result.known = true;
  result.v = Dv;
  for (std::size_t i = 0; i < at.dofs; ++i)
    if (system->kinds()[i] == DofKind::massive) result.v[static_cast<Eigen::Index>(i)] += x[i];
  for (std::size_t c = 0; c < mode.size(); ++c) {
    const bool takes = after.impulses[c].normal > 0.0;
    result.normal.push_back(takes ? -x[at.normal(c)] : 0.0);
    result.tangent.push_back(takes ? -x[at.tangent(c)] : 0.0);
  }
  return result;
}

}  // namespace signorini
