// told_run.hpp: what summary.json and events.csv of a run tell, as its witness takes it.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "signorini/result.hpp"

namespace signorini {

struct ToldSummary {
  Engine engine = Engine::ida;
  std::string flow;      ///< of exact: "modal" or "taylor"
  bool ended = true;     ///< false: it is still being written, or was killed
  bool stopped = false;  ///< before t_end
  double t = 0.0;        ///< reached
  std::map<std::string, long> events_by_type;
  std::vector<std::optional<Peak>> peaks;  ///< one a contact
};
/// Errors: FileError.
[[nodiscard]] ToldSummary told_summary(const std::filesystem::path& directory, const Model& model);

/// Rows of events.csv, all of them; states of laws of one's own are their kinds. Errors: FileError.
[[nodiscard]] std::vector<Event> told_events(const std::filesystem::path& directory, const Model& model);

/// Names of contacts to their places; a name that is none: FileError for this file and line.
class ContactNames {
 public:
  explicit ContactNames(const Model& model);
  [[nodiscard]] int at(const std::string& name, const std::filesystem::path& file, int line) const;

 private:
  std::map<std::string, int> places_;
};

}  // namespace signorini
