#include "study/prepared_run.hpp"

#include <fmt/core.h>

#include <utility>

#include "signorini/error.hpp"
#include "signorini/simulate.hpp"
#include "study/reduction/find_cutoff.hpp"

namespace signorini {

namespace {

PreparedRun built(Scene scene) {
  Model model = build_model(scene);
  return {std::move(scene), std::move(model)};
}

}  // namespace

PreparedRun prepare_run(const std::string& file, const std::vector<Override>& changes,
                        const std::function<bool()>& go_on) {
  return built(find_cutoff(read_scene(file, changes), go_on));
}

PreparedRun prepare_run(Scene scene, const std::optional<ReductionSpec>& found) {
  return built(find_cutoff(std::move(scene), found));
}

Report PreparedRun::ends(Recorder& recorder) const {
  return simulate(model, without_rows(scene.run), recorder);
}

KeptRun PreparedRun::keep(RunDirectory& directory, ForwardingRecorder& watch,
                          const std::optional<CertifyOptions>& certified) const {
  KeptRun kept;
  try {
    if (certified)
      kept.certified = simulate_certified(model, scene.run, watch, *certified);
    else
      kept.certified.report = simulate(model, scene.run, watch);
  } catch (const FileError& error) {
    if (!directory.started()) throw;
    directory.abandon(watch.reached(), error.what());
    throw FileError(error, fmt::format("; the run stopped at t = {:.9g} {}; what was computed until then "
                                       "is kept in {}",
                                       watch.reached(), model.units.time, directory.path().string()));
  }
  kept.summary = directory.finish(kept.certified);
  return kept;
}

RunSpec without_rows(RunSpec run) {
  run.output_dt.reset();
  run.output_times = std::vector<double>{0.0};
  run.frames.clear();
  return run;
}

}  // namespace signorini
