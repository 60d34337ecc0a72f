// summary.hpp: summary.json, what a run was and how it went, written and read back (docs/output.md).
//
//   outcome.kind: running (not ended, or killed), done, stopped, interrupted
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "signorini/certify.hpp"
#include "signorini/scene.hpp"

namespace signorini {

/// outcome.kind of a run that has ended.
[[nodiscard]] const char* to_string(Outcome::Kind kind);

/// summary.json of a run that has ended.
[[nodiscard]] std::string summary_json(const Scene& scene, const Model& model, const CertifiedReport& run,
                                       const std::vector<std::string>& command_line);

/// What can be said at the start: outcome.kind is "running", nothing counted yet.
[[nodiscard]] std::string running_json(const Scene& scene, const Model& model,
                                       const std::vector<std::string>& command_line);

/// The same of a run whose files could not be written: outcome.kind is "stopped", nothing counted.
[[nodiscard]] std::string abandoned_json(const Scene& scene, const Model& model,
                                         const std::vector<std::string>& command_line, double t,
                                         const std::string& reason);

/// What the pictures need to know about a run.
struct RunFacts {
  struct Contact {
    std::string name;
    bool slider = false;
    double static_friction = 0.0, kinetic_friction = 0.0;
  };
  std::string title, outcome;
  Units units;
  double t_end = 0.0;
  std::optional<double> certain_until;  ///< of a certified run whose sequence is not certain to its end
  std::vector<Contact> contacts;
  struct Response {
    std::string name, unit;
  };
  std::vector<Response> response;  ///< the columns of response.csv behind t
};

/// Reads them from DIR/summary.json. Errors: FileError.
[[nodiscard]] RunFacts read_run_facts(const std::filesystem::path& directory);

}  // namespace signorini
