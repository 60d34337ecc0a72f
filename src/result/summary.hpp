// summary.hpp: summary.json, inputs and outcome of a run, written and read (docs/output.md).
//
//   outcome.kind: running (not ended, or killed), done, stopped, interrupted
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "signorini/certify.hpp"
#include "signorini/scene.hpp"

namespace signorini::result {

/// outcome.kind of a run that has ended.
[[nodiscard]] const char* to_string(Outcome::Kind kind);

/// summary.json of a run that has ended.
[[nodiscard]] std::string summary_json(const Scene& scene, const Model& model, const CertifiedReport& run,
                                       const std::vector<std::string>& command_line);

/// summary.json at the start of a run: outcome.kind is "running"; results are omitted.
[[nodiscard]] std::string running_json(const Scene& scene, const Model& model,
                                       const std::vector<std::string>& command_line);

/// summary.json of a run whose files could not be written: outcome.kind is "stopped"; results are omitted.
[[nodiscard]] std::string abandoned_json(const Scene& scene, const Model& model,
                                         const std::vector<std::string>& command_line, double t,
                                         const std::string& reason);

/// Facts about a run for its pictures.
struct RunFacts {
  struct Contact {
    std::string name;
    bool slider = false;
    double static_friction = 0.0, kinetic_friction = 0.0;
  };
  std::string title, outcome;
  Units units;
  double t_end = 0.0;
  std::optional<double> certain_until;  ///< set for a run that is certified up to this time only
  std::vector<Contact> contacts;
  struct Response {
    std::string name, unit;
  };
  std::vector<Response> response;  ///< columns of response.csv after t
};

/// Reads the facts from DIR/summary.json. Errors: FileError.
[[nodiscard]] RunFacts read_run_facts(const std::filesystem::path& directory);

}  // namespace signorini::result
