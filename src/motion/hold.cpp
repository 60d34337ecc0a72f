#include "motion/hold.hpp"

#include "contact/motion.hpp"

#include <algorithm>

namespace signorini {
namespace {

/// x += the smallest change, in the norm of M, that adds `misses` to the forms of the contacts' rows. Returns the
/// corresponding multipliers of these forms, M times a length or a velocity.
Eigen::VectorXd correct(const ModeSystem& system, const std::vector<double>& misses, Vector& x) {
  if (std::all_of(misses.begin(), misses.end(), [](double miss) { return miss == 0.0; })) return {};
  const std::size_t n = system.unknowns().dofs, size = system.unknowns().size();
  std::vector<double> change(size, 0.0), work(size);
  std::copy(misses.begin(), misses.end(), change.begin() + static_cast<std::ptrdiff_t>(n));
  system.solve(change.data(), work.data());
  for (std::size_t i = 0; i < n; ++i)
    if (system.kinds()[i] == DofKind::massive) x[static_cast<Eigen::Index>(i)] += change[i];
  return -Eigen::Map<const Eigen::VectorXd>(change.data() + n, static_cast<Eigen::Index>(misses.size()));
}

}  // namespace

Eigen::VectorXd hold(const Model& model, const ModeSystem& system, const Forcing& forcing, double t,
                     Vector& u, Vector& v) {
  const Mode& mode = system.mode();
  const auto is_held = [&](std::size_t c) {
    return model.contacts[c].takes_impulses() && !mode[c].is_open();
  };
  const auto sticks = [&](std::size_t c) {
    return mode[c].state == State::stick && model.contacts[c].sticks_rigidly();
  };
  bool any = false;
  for (std::size_t c = 0; c < mode.size() && !any; ++c) any = is_held(c) || sticks(c);
  if (!any) return {};
  std::vector<double> places(model.layout.size(mode.size()), 0.0), rates(places);
  for (std::size_t c = 0; c < mode.size(); ++c) {
    const Contact& contact = model.contacts[c];
    if (is_held(c)) {
      places[model.layout.normal(c)] = -contact.gap_at(u);
      rates[model.layout.normal(c)] = -gap_rate(contact, v);
    }
    if (sticks(c)) rates[model.layout.tangent(c)] = -along_surface(contact, v, forcing.surface(c, t, 1));
  }
  correct(system, places, u);
  Eigen::VectorXd impulses = correct(system, rates, v);
  for (std::size_t c = 0; c < mode.size(); ++c) {
    const Contact& contact = model.contacts[c];
    const bool held = is_held(c), still = sticks(c);
    const double surface = still ? forcing.surface(c, t, 1) : 0.0;
    if (held) set_exactly(contact.normal, -contact.gap, u);
    if (held && still) {
      set_exactly(contact.normal, 0.0, contact.tangent, surface, v);
    } else {
      if (held) set_exactly(contact.normal, 0.0, v);
      if (still) set_exactly(contact.tangent, surface, v);
    }
  }
  return impulses;
}

}  // namespace signorini
