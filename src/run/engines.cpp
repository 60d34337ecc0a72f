#include "run/engines.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "base/rounding.hpp"
#include "base/text.hpp"
#include "contact/friction.hpp"
#include "engine/exact/modal/modal_engine.hpp"
#include "engine/ida/ida_engine.hpp"
#include "engine/ida/restart_order.hpp"
#include "engine/newmark/friction_iteration.hpp"
#include "engine/newmark/newmark_engine.hpp"
#include "linear/redundant_rows.hpp"
#include "model/internal_units.hpp"
#include "run/choose_engine.hpp"
#include "signorini/error.hpp"

namespace signorini::run {
namespace {

constexpr const char* ida_instead = "use \"ida\"";

[[noreturn]] void refuse(const RunSpec& run, const std::string& what, const std::string& instead) {
  throw UnsupportedSceneError(run, what, instead);
}

void refuse_nothing(const Model& /*model*/, const RunSpec& /*run*/) {}

void refuse_user_laws(const Model& model, const RunSpec& run) {
  for (const Contact& contact : model.contacts)
    if (contact.has_linear_coulomb_law())
      continue;
    else if (contact.law->is_named())
      refuse(run,
             fmt::format("does not support law \"{}\" of contact '{}'", contact.law->name(), contact.name),
             ida_instead);
    else
      refuse(run,
             fmt::format("supports only the built-in laws, and contact '{}' has a user law", contact.name),
             ida_instead);
}

void refuse_nonlinear_laws(const Model& model, const RunSpec& run) {
  for (const Contact& contact : model.contacts) {
    if (contact.curved_surface())
      refuse(
          run,
          fmt::format(
              "needs constant stiffnesses, but the stiffness of pendulum '{}' varies with its normal force",
              contact.name),
          ida_instead);
    if (contact::friction_varies(contact))
      refuse(run,
             fmt::format("needs linear laws, but the friction of contact '{}' depends on its {}",
                         contact.name, contact.friction.is_load_dependent() ? "normal force" : "slip rate"),
             ida_instead);
  }
}

void refuse_user_and_nonlinear_laws(const Model& model, const RunSpec& run) {
  refuse_user_laws(model, run);
  refuse_nonlinear_laws(model, run);
}

void refuse_functions(const Model& model, const RunSpec& run) {
  const auto check = [&](const History& history, const std::string& what) {
    if (!history.has_closed_form())
      refuse(run, fmt::format("needs loads in closed form, but {} is a user function", what),
             "use \"ida\" or \"newmark\"");
  };
  for (const Load& load : model.loads) check(load.history, load.name);
  for (const Contact& contact : model.contacts) {
    check(contact.normal_force, "normal_force of contact '" + contact.name + "'");
    check(contact.surface_motion, "the surface of contact '" + contact.name + "'");
  }
}

/// Refusals of an engine that iterates on friction forces: such an engine cannot compute impulses of rigid contacts.
void refuse_for_friction_iteration(const Model& model, const RunSpec& run) {
  refuse_user_and_nonlinear_laws(model, run);
  refuse_functions(model, run);
  for (const Contact& contact : model.contacts) {
    if (contact.takes_impulses())
      refuse(run, fmt::format("needs contact elements, and contact '{}' is rigid", contact.name),
             "use \"newmark\" or law = \"compliant\"");
  }
  const linear::RedundantRows shared(model, linear::SystemMatrices(model));
  if (shared.groups().empty()) return;
  std::vector<std::string> names;
  for (const std::size_t k : shared.groups().front()) names.push_back(model.contacts[k].name);
  refuse(run,
         fmt::format("solves each contact alone, but contacts {} may restrain the same motion together",
                     base::join_quoted(names, 5)),
         "use \"newmark\" or a tangential_stiffness");
}

/// A step of the series covers a few radians of the highest frequency. After 1/eps radians, such a step no longer changes
/// the time as a double.
void refuse_unresolved_steps(const Model& model, const RunSpec& run) {
  const double radians = model.omega_max * run.t_end;
  if (!(radians > 1.0 / rounding::eps) || choose_flow(model, run).modal) return;
  refuse(
      run,
      fmt::format("computes the highest frequency, {:.3g} rad/{}, by series; its phase advances by {:.2g} "
                  "radians until t_end, so that a step is shorter than the resolution of t_end as a double",
                  model::in_scene_units(model, model.omega_max, unit::rate), model.units.time, radians),
      "use \"ida\", or less stiffness");
}

/// Refusals of a series, which must include all terms of polynomials in the forcing.
void refuse_for_series(const Model& model, const RunSpec& run) {
  refuse_nonlinear_laws(model, run);
  refuse_functions(model, run);
  const auto check = [&](const History& history, const std::string& what) {
    for (const Piece& p : history.pieces())
      for (std::size_t j = exact::max_levels - 1; j < p.coefficients.size(); ++j)
        if (p.coefficients[j] != 0.0)
          refuse(run,
                 fmt::format("supports polynomials up to degree {}, but {} has degree {} or more",
                             exact::max_levels - 2, what, j),
                 "");
  };
  for (const Load& load : model.loads) check(load.history, load.name);
  for (const Contact& contact : model.contacts) {
    check(contact.normal_force, "normal_force of contact '" + contact.name + "'");
    check(contact.surface_motion, "the surface of contact '" + contact.name + "'");
  }
  refuse_unresolved_steps(model, run);
}

Method closed_flow(const Model& model, const RunSpec& run) {
  FlowChoice flow = choose_flow(model, run);
  return {run.engine,
          false,
          "",
          0.0,
          exact::max_levels,
          flow.modal ? "for the Taylor series of states without modes; rtol is not used"
                     : "Taylor series with as many terms as rounding accuracy needs; rtol is not used",
          flow.modal ? "modal" : "taylor",
          std::move(flow.reason)};
}

Method bdf(const Model& model, const RunSpec& run) {
  const ida::OrderChoice order = ida::choose_order(model, run);
  return {run.engine, false, "", run.rtol, order.max_order, order.reason};
}

Method fixed_steps(const Model& /*model*/, const RunSpec& run) {
  if (!run.dt)
    throw SceneError(
        run.place, "run.dt",
        fmt::format("missing, expected the time step, which engine \"{}\" needs", to_string(run.engine)));
  return {run.engine, false, "", *run.dt, 2, "average acceleration"};
}

std::unique_ptr<engine::Stepper> make_exact(const EngineParts& p) {
  if (choose_flow(p.model, p.run).modal)
    return std::make_unique<modal::ModalEngine>(
        p.model, p.structure, p.systems, p.run.t_end,
        modal::ModalOptions{p.needs.modal, p.needs.peaks, p.needs.step_seed, p.watched});
  return std::make_unique<exact::ExactEngine>(p.model, p.structure, p.systems, p.run.t_end,
                                              exact::SeriesOptions{p.without_listeners, p.needs.step_seed});
}

std::unique_ptr<engine::Stepper> make_ida(const EngineParts& p) {
  return std::make_unique<ida::IdaEngine>(p.model, p.structure, p.systems, p.tolerance, p.max_order,
                                          p.run.t_end, p.run.flight_tolerances);
}

std::unique_ptr<engine::Stepper> make_newmark(const EngineParts& p) {
  return std::make_unique<newmark::NewmarkEngine>(p.model, p.structure, p.systems, p.run, p.tolerance);
}

std::unique_ptr<engine::Stepper> make_friction_iteration(const EngineParts& p) {
  return std::make_unique<newmark::FrictionIteration>(p.model, p.structure, p.systems, p.run);
}

bool always(const RunSpec& /*run*/) { return true; }
bool never(const RunSpec& /*run*/) { return false; }
bool refines_on_exact_motion(const RunSpec& run) { return run.refine != Refine::linear; }
bool all_flights(const Model& /*model*/) { return true; }
bool no_flights(const Model& /*model*/) { return false; }

constexpr std::array rows_of_engines = {
    EngineRow{Engine::exact,
              EngineRole::closed_form,
              {.closed_form_flow = true,
               .supports_orbits = true,
               .laws_at_step_ends = true,
               .locates_events = always,
               .resolves_low_flights = all_flights},
              refuse_for_series,
              closed_flow,
              make_exact,
              cost_of_exact},
    EngineRow{Engine::ida,
              EngineRole::integrator,
              {.supports_orbits = true,
               .laws_at_step_ends = true,
               .locates_events = always,
               .resolves_low_flights = ida::IdaEngine::follows_low_flights},
              refuse_nothing,
              bdf,
              make_ida,
              cost_of_bdf},
    EngineRow{Engine::newmark,
              EngineRole::fixed_steps,
              {.discrete_derivatives = true,
               .laws_at_step_ends = true,
               .locates_events = refines_on_exact_motion,
               .resolves_low_flights = no_flights},
              refuse_user_and_nonlinear_laws,
              fixed_steps,
              make_newmark,
              cost_of_fixed_steps},
    EngineRow{Engine::friction_iteration,
              EngineRole::none,
              {.locates_events = never, .resolves_low_flights = no_flights},
              refuse_for_friction_iteration,
              fixed_steps,
              make_friction_iteration,
              cost_of_fixed_steps},
};
static_assert(rows_of_engines.size() == all_engines.size());

}  // namespace

UnsupportedSceneError::UnsupportedSceneError(const RunSpec& run, const std::string& what,
                                             const std::string& instead)
    : SceneError(run.place, "run.engine",
                 fmt::format("engine \"{}\" {}{}{}", to_string(run.engine), what, instead.empty() ? "" : "; ",
                             instead)),
      reason(what) {}

const EngineRow& engine_row(Engine engine) {
  return *std::find_if(rows_of_engines.begin(), rows_of_engines.end(),
                       [&](const EngineRow& row) { return row.engine == engine; });
}

Engine engine_for(EngineRole role) {
  return std::find_if(rows_of_engines.begin(), rows_of_engines.end(),
                      [&](const EngineRow& row) { return row.role == role; })
      ->engine;
}

std::string engines_that(bool EngineCapabilities::*can) {
  std::string names;
  for (const EngineRow& row : rows_of_engines)
    if (row.capabilities.*can)
      names += fmt::format("{}\"{}\"", names.empty() ? "" : " or ", to_string(row.engine));
  return names;
}

}  // namespace signorini::run
