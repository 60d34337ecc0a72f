#include "decide/release.hpp"

#include <algorithm>

#include "motion/hold.hpp"

namespace signorini {

bool carries_massless(const Model& model, const Contact& contact) {
  const auto massless = [&](const Combination& form) {
    return std::any_of(form.terms.begin(), form.terms.end(), [&](const auto& term) {
      return model.dofs[static_cast<std::size_t>(term.first)].massless;
    });
  };
  return massless(contact.normal) || massless(contact.tangent);
}

std::optional<Vector> released(ModeSystems& systems, JetMaker& jets, const Forcing& forcing,
                               const Instant& instant, Mode mode, std::size_t c) {
  const Model& model = systems.model();
  const Contact& contact = model.contacts[c];
  if (!contact.is_elastic_along_normal() || !carries_massless(model, contact)) return std::nullopt;
  mode[c] = {State::open, 0.0};
  const ModeSystemPtr system = systems.of(mode);
  if (!system) return std::nullopt;
  Vector u = instant.u, v = instant.v;
  hold(model, *system, forcing, instant.t, u, v);
  std::vector<MotionJet> motions;
  const Jet jet = jets.make(system, forcing, instant.t, u, v, motions);
  u = jet.u.col(0);
  if (!(contact.gap_at(u) > contact.gap_at(instant.u))) return std::nullopt;
  return u;
}

}  // namespace signorini
