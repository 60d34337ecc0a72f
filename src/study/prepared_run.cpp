#include "study/prepared_run.hpp"

#include <utility>

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

RunSpec without_rows(RunSpec run) {
  run.output_dt.reset();
  run.output_times = std::vector<double>{0.0};
  run.frames.clear();
  return run;
}

}  // namespace signorini
