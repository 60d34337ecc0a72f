// stretch.hpp: an engine on its way through one state, without the loop around it.
//
//   scene -> decision at t = 0 -> engine -> advance() ... -> the first event or the end
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <memory>

#include "decide/contact_state_solver.hpp"
#include "decide/driven_states.hpp"
#include "engine/tolerance.hpp"
#include "motion/point.hpp"
#include "run/engines.hpp"

namespace signorini::tests {

class Stretch {
 public:
  explicit Stretch(const std::string& text, const std::vector<Override>& changes = {},
                   std::optional<std::vector<int>> watched = {})
      : Stretch(parse_scene(text, "test.toml", changes), std::move(watched)) {}
  explicit Stretch(const Scene& scene, std::optional<std::vector<int>> watched = {})
      : Stretch(build_model(scene), scene.run, std::move(watched)) {}
  /// watched: EngineParts::watched.
  Stretch(Model of, const RunSpec& as, std::optional<std::vector<int>> watched = {})
      : model(std::move(of)),
        run(as),
        structure(model),
        systems(model, structure),
        tolerance(engine::tolerance_of(model, run)),
        decider(systems, 100, tolerance.capture_velocity()),
        forcing(model, 0.0, motion::Side::after),
        row(run::engine_row(run.engine)),
        engine(row.make({model,
                         structure,
                         systems,
                         run,
                         tolerance,
                         row.method(model, run).max_order,
                         {},
                         false,
                         std::move(watched)})),
        decision(begun()) {
    engine->start({run.t_end, &decision, &forcing});
  }

  /// To the first event or the end; after each step `see`.
  engine::Step go(const std::function<void(const engine::Step&)>& see = {}) {
    engine::Step step;
    do {
      step = engine->advance();
      if (step.kind == engine::Step::Kind::failed) return step;
      if (see) see(step);
    } while (step.kind == engine::Step::Kind::accepted && step.end < run.t_end);
    return step;
  }

  /// What stood in the point before must not matter.
  [[nodiscard]] motion::Point at(double t) {
    const Vector nothing = Vector::Constant(model.size(), std::numeric_limits<double>::quiet_NaN());
    motion::Point point{nothing, nothing, nothing, nothing};
    engine->dense_output().evaluate(t, point);
    engine->dense_output().accelerate(t, point);
    return point;
  }

  /// Integrals of the powers along the engine's own motion, by Gauss's rule on `parts` parts.
  void add_powers(double from, double to, int parts, motion::WorkIntegrals& works) {
    constexpr std::array x{0.1488743389816312, 0.4333953941292472, 0.6794095682990244, 0.8650633666889845,
                           0.9739065285171717};
    constexpr std::array w{0.2955242247147529, 0.2692667193099963, 0.2190863625159820, 0.1494513491505806,
                           0.0666713443086881};
    motion::Powers powers(model, structure);
    std::vector<double> now(powers.count(), std::numeric_limits<double>::quiet_NaN());
    const double half = 0.5 * (to - from) / parts;
    for (int part = 0; part < parts; ++part)
      for (std::size_t i = 0; i < x.size(); ++i)
        for (const double side : {-1.0, 1.0}) {
          const double t = from + half * (2 * part + 1 + side * x[i]);
          const motion::Point point = at(t);
          std::vector<ContactMotion> motions;
          for (std::size_t c = 0; c < model.contacts.size(); ++c)
            motions.push_back(motion::motion_of(model.contacts[c], c, forcing, t, point));
          powers.at(forcing, t, decision.states, point, motions, now.data());
          powers.add(now.data(), half * w[i], works);
        }
  }

  /// Across the event that a step has found: false where no state goes on.
  bool pass(const engine::Step& event) {
    decide::Instant now = instant(event.end, event.resolution);
    const motion::Point point = at(event.end);
    now.u = point.u;
    now.v = point.v;
    now.states = decision.states;
    now.triggered = event.triggered;
    now.resting_limits = decide::find_resting_limits(decision);
    decision = event.engine_states ? decider.adopt(now, *event.engine_states, forcing)
                                   : decider.decide(now, forcing, forcing);
    if (decision.consistent) engine->start({run.t_end, &decision, &forcing});
    return decision.consistent;
  }

  Model model;
  RunSpec run;
  linear::SystemMatrices structure;
  motion::StateSystems systems;
  engine::Tolerance tolerance;
  decide::ContactStateSolver decider;
  motion::Forcing forcing;
  const run::EngineRow& row;
  std::unique_ptr<engine::Stepper> engine;
  decide::Decision decision;

 private:
  [[nodiscard]] decide::Instant instant(double t, double resolution) const {
    decide::Instant now;
    now.t = t;
    now.resolution = resolution;
    now.resolves_low_flights = engine->resolves_low_flights;
    return now;
  }
  decide::Decision begun() {
    decide::Instant now = instant(0.0, motion::resolution_at(0.0, 0.0));
    now.u = model.u0;
    now.v = model.v0;
    now.start = true;
    now.states = decide::initial_states(model, forcing, 0.0, model.u0, model.v0);
    return decider.decide(std::move(now), forcing, forcing);
  }
};

}  // namespace signorini::tests
