// simulate.hpp: from a model to its motion.
//
//   0 = u' - v
//   0 = M v' + C v + K u - P(t) + sum_k ( n_k N_k + t_k T_k )
//   0 = two rows a contact, chosen by its state (contact.hpp)
//
//   Scene scene = read_scene("models/pipeline.toml");
//   Result result = simulate(build_model(scene), scene.run);
#pragma once

#include "signorini/model.hpp"
#include "signorini/result.hpp"

namespace signorini {

/// Runs to settings.t_end; rows go to the recorder as they come. Never throws for a run that cannot go
/// on: the Report's Outcome says when, where and why. Errors: SceneError for what an engine refuses.
[[nodiscard]] Report simulate(const Model& model, const RunSpec& settings, Recorder& recorder);

/// The same, kept in memory.
[[nodiscard]] Result simulate(const Model& model, const RunSpec& settings);

}  // namespace signorini
