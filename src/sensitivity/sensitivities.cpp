// sensitivities(): builds the model and its derivatives, then makes one run with the tangents.
#include <fmt/core.h>

#include <cmath>

#include "model/build.hpp"
#include "model/internal_units.hpp"
#include "run/engines.hpp"
#include "scene/overrides.hpp"
#include "scene/toml_node.hpp"
#include "sensitivity/contact_rates.hpp"
#include "sensitivity/discrete_run.hpp"
#include "sensitivity/parameter.hpp"
#include "sensitivity/rate_record.hpp"
#include "sensitivity/tangent_run.hpp"
#include "signorini/error.hpp"

namespace signorini {
namespace {

/// Refuses keys that control the computation and have no effect on the motion.
void check_path(const std::string& path) {
  for (const std::string_view table : {"run.", "reduction.", "schema", "title", "units"})
    if (path.starts_with(table) && !path.starts_with("run.initial"))
      throw UsageError(fmt::format("--parameter {}: the motion does not depend on this key", path));
}

void check_options(const RunSpec& run, const SensitivityOptions& options) {
  if (!options.discrete) return;
  if (!run::engine_row(run.engine).capabilities.discrete_derivatives)
    throw UsageError(fmt::format(
        "discrete derivatives need fixed time steps: found engine {}, expected run.engine = {}",
        to_string(run.engine), run::engines_that(&run::EngineCapabilities::discrete_derivatives)));
  if (options.losses)
    throw UsageError(
        "losses and discrete derivatives cannot be combined: losses are computed for the continuous motion "
        "only");
}

/// Adds a weight load of value zero as a place for derivatives with respect to gravity, because zero gravity makes no load.
void make_room_for_weight(const SceneReader& read, const Scene& scene, const std::vector<std::string>& paths,
                          Model& model) {
  if (scene.gravity != std::array{0.0, 0.0}) return;
  for (const std::string& path : paths)
    for (const double g : {-1.0, 1.0}) {
      if (!path.starts_with("gravity.")) continue;
      try {
        sensitivity::add_weight_load(model::build_without_warnings(read({sensitivity::set_to(path, g)})),
                                     model);
      } catch (const Error&) {  // derivative() reports the error
      }
    }
}

/// Settings without a companion run, which does not contribute to derivatives.
RunSpec without_companion(RunSpec run) {
  run.certify = Certify::no;
  return run;
}

}  // namespace

SceneReader reader_of(std::string path, std::vector<Override> always) {
  std::string text = scene::scene_text(path);
  return [text = std::move(text), path = std::move(path),
          always = std::move(always)](const std::vector<Override>& changes) {
    std::vector<Override> all = always;
    all.insert(all.end(), changes.begin(), changes.end());
    return parse_scene(text, path, all);
  };
}

Sensitivities sensitivities(const SceneReader& read, const std::vector<std::string>& paths,
                            Recorder* recorder, const SensitivityOptions& options) {
  if (recorder != nullptr && recorder->steers())
    throw UsageError(
        "sensitivities: expected a recorder that does not steer, because derivatives cannot include the "
        "changes "
        "that a recorder makes during the run");
  const Scene scene = read({});
  Model model = build_model(scene);
  sensitivity::check_tangent_laws(scene, model);
  make_room_for_weight(read, scene, paths, model);
  const RunSpec run = without_companion(scene.run);
  check_options(run, options);
  const Factors to_machine{1.0 / model.internal_units.force, 1.0 / model.internal_units.length,
                           1.0 / model.internal_units.time};
  const Model computed = model::rescaled(model, to_machine);
  Sensitivities result;
  result.units = model.units;
  result.title = model.title;
  std::vector<sensitivity::ModelDerivative> derivatives;
  std::vector<double> sizes;
  for (const std::string& path : paths) {
    check_path(path);
    Parameter parameter;
    parameter.path = path;
    parameter.value = sensitivity::value_of(scene, path);
    if (const scene::Key* key = scene::key_of(path))
      parameter.is_valid = [range = scene::range_of(*key)](double value) { return range.contains(value); };
    const double size = parameter.value != 0.0 ? std::abs(parameter.value)
                                               : sensitivity::typical_size(read, scene, model, path);
    derivatives.push_back(sensitivity::derivative(read, computed, path, parameter.value, size));
    parameter.step = derivatives.back().step;
    sizes.push_back(size);
    result.parameters.push_back(std::move(parameter));
  }
  sensitivity::RateRecord record(computed, derivatives, recorder, result, options.losses);
  const RunSpec inside = scene::rescaled(run, to_machine);
  const auto follow = [&](auto& tangents) {
    result.report = run::simulate(model, run, record, tangents, tangents.needs());
    record.finish();
    for (std::size_t p = 0; p < paths.size(); ++p)
      if (const sensitivity::TangentState& state = tangents.states()[p]; !state.valid) {
        result.parameters[p].until = state.valid_until * computed.unit.time;
        result.parameters[p].reason = state.reason;
      }
  };
  if (options.discrete) {
    sensitivity::DiscreteRun tangents(computed, inside, derivatives, sizes, record);
    follow(tangents);
  } else {
    sensitivity::TangentRun tangents(computed, inside, derivatives, sizes, record, options.losses);
    follow(tangents);
    result.stretches = tangents.stretches();
    result.stretches.correction *= computed.unit.time;
  }
  return result;
}

std::vector<SequenceChange> smallest_sequence_changes(const Sensitivities& s) {
  std::vector<SequenceChange> found;
  for (std::size_t p = 0; p < s.parameters.size(); ++p) {
    std::optional<SequenceChange> up, down;
    for (std::size_t i = 0; i + 1 < s.events.size(); ++i) {
      const double apart = s.events[i + 1].t - s.events[i].t;
      const double closing = s.event_rates[i][p].t - s.event_rates[i + 1][p].t;
      if (!(apart > 0.0) || !(std::abs(closing) > 0.0)) continue;
      const bool vanish = s.events[i].contact >= 0 && s.events[i].contact == s.events[i + 1].contact;
      const SequenceChange swap{p, i, i + 1, apart / closing, vanish};
      if (!s.parameters[p].is_valid(s.parameters[p].value + swap.change)) continue;
      std::optional<SequenceChange>& least = swap.change > 0.0 ? up : down;
      if (!least || std::abs(swap.change) < std::abs(least->change)) least = swap;
    }
    if (down) found.push_back(*down);
    if (up) found.push_back(*up);
  }
  return found;
}

}  // namespace signorini
