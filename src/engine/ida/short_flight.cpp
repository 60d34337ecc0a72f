#include "engine/ida/short_flight.hpp"

#include <algorithm>

#include "contact/friction.hpp"

namespace signorini::ida {
namespace {

constexpr int looks = 16;  // number of samples of the height of a flight

/// True if a Taylor series can represent the motion in these contact states. If friction depends on the slip rate, the radius
/// of convergence is unknown. If friction depends on N, the friction limit of a sticking contact is not a polynomial.
bool is_linear(const Model& model, const contact::ContactStates& states) {
  for (std::size_t c = 0; c < states.size(); ++c) {
    const Contact& contact = model.contacts[c];
    if (contact::slips_nonlinearly(contact, states[c].state)) return false;
    if (contact.friction.is_load_dependent() && !states[c].is_open()) return false;
  }
  return true;
}

}  // namespace

ShortFlight::ShortFlight(const Model& model, const linear::SystemMatrices& structure,
                         motion::StateSystems& systems, double t_end)
    : model_(model), series_(std::make_unique<exact::ExactEngine>(model, structure, systems, t_end)) {}

std::optional<engine::Step> ShortFlight::take(const engine::Segment& segment,
                                              const std::function<double(const Contact&)>& level) {
  const decide::Decision& decision = *segment.decision;
  const auto leaves = [&](std::size_t slot) {
    const decide::GuardStart& guard = decision.guards[slot];
    return guard.kind == Guard::closing && guard.at_zero && guard.leading_order > 0 &&
           model_.contacts[model_.layout.contact_of_guard(slot)].takes_impulses();
  };
  bool any = false;
  for (std::size_t slot = 0; slot < decision.guards.size(); ++slot) any = any || leaves(slot);
  if (!any || !is_linear(model_, decision.states)) return std::nullopt;
  series_->start(segment);
  engine::Step step = series_->advance();
  if (step.kind != engine::Step::Kind::event) return std::nullopt;
  // The flight must be low up to the end of the step, which may be an event of another contact before the impact.
  for (std::size_t slot = 0; slot < decision.guards.size(); ++slot) {
    if (!leaves(slot)) continue;
    const Contact& contact = model_.contacts[model_.layout.contact_of_guard(slot)];
    const double lowest = level(contact);
    motion::Point point;
    for (int i = 1; i <= looks; ++i) {
      series_->evaluate(step.begin + (step.end - step.begin) * i / looks, point);
      if (contact.gap_at(point.u) > lowest) return std::nullopt;
    }
  }
  return step;
}

}  // namespace signorini::ida
