// prepared_run.hpp: a scene, changed or not, ready to run.
//
//   file + overrides -read-> Scene -cutoff of [reduction] tolerance-> Scene -build-> Model
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "signorini/model.hpp"
#include "signorini/scene.hpp"

namespace signorini {

struct PreparedRun {
  Scene scene;  ///< with the cutoff that was found
  Model model;
};

/// go_on: as of find_cutoff. Errors: those of read_scene, find_cutoff and build_model.
[[nodiscard]] PreparedRun prepare_run(
    const std::string& file, const std::vector<Override>& changes,
    const std::function<bool()>& go_on = [] { return true; });
/// One of several runs that are compared, with the cutoff that was `found` for the first.
[[nodiscard]] PreparedRun prepare_run(Scene scene, const std::optional<ReductionSpec>& found);

/// The same run with rows of output at both ends only.
[[nodiscard]] RunSpec without_rows(RunSpec run);

}  // namespace signorini
