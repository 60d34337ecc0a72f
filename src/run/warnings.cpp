#include "run/warnings.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/rounding.hpp"
#include "base/text.hpp"
#include "contact/friction.hpp"
#include "engine/newmark/newmark_step.hpp"
#include "model/internal_units.hpp"
#include "run/engines.hpp"

namespace signorini::run {
namespace {

// Limit of the phase angle a of a load in one step, in rad: the impulse of a half wave has the relative error a^2 / 12.
constexpr double max_turned = 1.0;
constexpr double much_energy = 1e-3;  // an error above this fraction of the exchanged energy is reported
// An error below this fraction of force scale * length scale, or of the initial energy, is rounding of a structure at
// rest and is not reported.
constexpr double least_energy = 1e-9;
constexpr int max_warnings_of_a_kind = 5;  // limit; further warnings of the same kind are omitted

}  // namespace

std::vector<std::string> shear_limit_warnings(const Model& model, const decide::Decision& start) {
  std::vector<std::string> sentences;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    const double asked = c.initial_shear, found = start.after[k].T;
    // The limit fs |N|, N = kn g, has the rounding error of the terms of g; a smaller reduction of T causes no warning.
    const double limit = c.normal_spring() ? contact::static_friction(c) * c.normal_stiffness *
                                                 (std::abs(c.gap) + c.normal.magnitude(model.u0))
                                           : std::abs(asked);
    const bool cut =
        std::abs(asked) - std::abs(found) > rounding::many_operations * std::max(std::abs(asked), limit);
    if (!start.visited[k] || !start.jumped[k] || !cut) continue;
    sentences.push_back(fmt::format(
        "contact '{}': initial_shear = {:.6g} {} is above the friction limit at t = 0; T starts at {:.6g} {}",
        model.contacts[k].name, model::in_scene_units(model, asked, unit::force), model.units.force,
        model::in_scene_units(model, found, unit::force), model.units.force));
  }
  return sentences;
}

std::vector<std::string> fast_load_warnings(const Model& model, const RunSpec& run) {
  std::vector<std::string> sentences;
  if (engine_info(run.engine).accuracy != Accuracy::step || run.step != StepControl::fixed || !run.dt)
    return sentences;
  for (const Load& load : model.loads) {
    double omega = 0.0;
    const std::vector<double>& starts = load.history.starts();
    for (std::size_t i = 0; i <= starts.size(); ++i) {
      const Piece& piece = load.history.pieces()[i];
      const double from = i == 0 ? 0.0 : std::max(0.0, starts[i - 1]),
                   to = i == starts.size() ? run.t_end : std::min(run.t_end, starts[i]);
      if (piece.amplitude != 0.0 && to - from >= newmark::short_segment_steps * *run.dt)
        omega = std::max(omega, std::abs(piece.omega));
    }
    if (omega * *run.dt > max_turned)
      sentences.push_back(fmt::format(
          "the phase of '{}' advances by {:.3g} rad in a step of run.dt = {:.6g}, so the step is too coarse; "
          "use a smaller run.dt",
          load.name, omega * *run.dt, model::time_in_scene_units(model, *run.dt)));
  }
  return sentences;
}

namespace {

// Texts of warnings. t: time in the unit of the scene.

std::string impact_gain(double t, double gain) {
  return fmt::format(
      "the impact at t = {:.9g} gains the energy {:.4g}: Newton's law of restitution with friction can add "
      "energy",
      t, gain);
}

std::optional<std::string> shared_motion(const Model& model, const decide::Decision& decision, double t) {
  std::vector<bool> shares(model.contacts.size(), false);
  if (decision.system)
    for (const linear::SharedForces& shared : decision.system->factorised().shared)
      for (std::size_t i = 0; i < shared.rows.size(); ++i)
        if (linear::participates_in(shared.null, static_cast<Eigen::Index>(i)))
          shares[model.layout.contact_of(shared.rows[i])] = true;
  // A contact at its limit that has no guard of the slip rate is held at rest by other contacts.
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    bool held_at_limit = slip_sign(decision.states[c].state) != 0 && model.contacts[c].sticks_rigidly();
    for (std::size_t slot = model.layout.guard(c); slot < model.layout.guard_end(c); ++slot)
      held_at_limit = held_at_limit && decision.guards[slot].kind != Guard::sliding;
    if (held_at_limit) shares[c] = true;
  }
  std::vector<std::string> names;
  for (std::size_t c = 0; c < model.contacts.size(); ++c)
    if (shares[c]) names.push_back(model.contacts[c].name);
  if (names.empty()) return std::nullopt;
  return fmt::format(
      "from t = {1:.6g} on {0} prevent the same motion: the motion is unique, but the friction forces are "
      "not; the run has the forces of least sum of squares within the friction limits",
      names.size() > 1 ? "contacts " + base::join_quoted(names, 5)
                       : "contact " + base::join_quoted(names, 5) + " and other contacts",
      t);
}

std::string release_warning(const Model& model, std::size_t c, double t) {
  return fmt::format(
      "contact '{}' released at t = {:.9g}, because no continuous motion exists there: the massless parts "
      "jumped to the equilibrium without the contact; add mass or a damper to avoid such jumps",
      model.contacts[c].name, t);
}

std::string limit_warning(const Model& model, const decide::ContactAtLimit& found, double t) {
  const Contact& c = model.contacts[found.contact];
  return fmt::format(
      "contact '{}' sticks at its friction limit from t = {:.9g} on: the required force is {:.2g} {} {} the "
      "limit, and its rounding error is {:.2g} {}, so stick and slip cannot be distinguished, although "
      "friction drops at the start of slip; the contact is treated as sticking",
      c.name, t, model::in_scene_units(model, std::abs(found.margin), unit::force), model.units.force,
      found.margin < 0.0 ? "above" : "below", model::in_scene_units(model, found.noise, unit::force),
      model.units.force);
}

}  // namespace

void DecisionWarnings::add(double t, const decide::Decision& decision, std::vector<std::string>& warnings) {
  const double at = model::time_in_scene_units(model_, t);
  for (const std::size_t c : decision.released)
    if (++releases_ <= max_warnings_of_a_kind) warnings.push_back(release_warning(model_, c, at));
  if (!shared_motion_reported_)
    if (auto sentence = shared_motion(model_, decision, at)) {
      warnings.push_back(std::move(*sentence));
      shared_motion_reported_ = true;
    }
  for (const decide::ContactAtLimit& found : decision.at_limit)
    if (model_.contacts[found.contact].friction.has_static_drop() && ++at_limit_ <= max_warnings_of_a_kind)
      warnings.push_back(limit_warning(model_, found, at));
  if (decision.impact_gains_energy && ++gains_ <= max_warnings_of_a_kind)
    warnings.push_back(impact_gain(at, model::in_scene_units(model_, -decision.impact_loss, unit::energy)));
}

std::optional<std::string> energy_warning(const Audit& audit, const Method& method, double rounding,
                                          bool other) {
  const double off = audit.energy.value;
  const double scale = std::max(audit.force_scale * audit.length_scale, audit.initial.stored());
  if (!(off > much_energy * audit.energy_scale && off > least_energy * scale && off > rounding))
    return std::nullopt;
  const std::string much =
      off > audit.energy_scale
          ? fmt::format("{:.2g}, more than the exchanged energy ({:.2g})", off, audit.energy_scale)
          : fmt::format("{:.2g} of the exchanged energy", off / audit.energy_scale);
  const std::string warning =
      fmt::format("the energy balance has an error of {} (at t = {:.6g}); ", much, audit.energy.t);
  if (engine_info(method.engine).accuracy == Accuracy::rounding)
    return warning + "signorini verify compares this run with two other engines";
  const bool steps = engine_info(method.engine).accuracy == Accuracy::step;
  return warning + (steps ? "use a smaller run.dt" : "use a smaller rtol, or an atol that fits the motion") +
         (other ? fmt::format(", or engine \"{}\"", to_string(engine_for(EngineRole::closed_form))) : "");
}

}  // namespace signorini::run
