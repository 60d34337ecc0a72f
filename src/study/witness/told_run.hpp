// told_run.hpp: what summary.json and events.csv of a run tell, as its witness takes it.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "signorini/result.hpp"

namespace signorini {

class CsvReader;

struct ToldSummary {
  Engine engine = Engine::automatic;
  std::string flow;      ///< of exact: "modal" or "taylor"
  bool ended = true;     ///< false: it is still being written, or was killed
  bool stopped = false;  ///< before t_end
  double t = 0.0;        ///< reached
  long total = 0;        ///< events
  std::map<std::string, long> events_by_type;
  /// Of each contact; none: an older run.
  struct Load {
    double least_N = 0.0, greatest_N = 0.0, least_T = 0.0, greatest_T = 0.0;
  };
  std::vector<std::optional<Load>> loads;
  std::vector<std::optional<Peak>> peaks;  ///< one a contact
};
/// Errors: FileError.
[[nodiscard]] ToldSummary told_summary(const std::filesystem::path& directory, const Model& model);

/// Rows of events.csv, all of them; states of laws of one's own are their kinds. ended: a last line without its line break
/// is cut. Errors: FileError.
[[nodiscard]] std::vector<Event> told_events(const std::filesystem::path& directory, const Model& model,
                                             bool ended);

/// What a table that ends too early says: the line where it does, and what it lacks.
[[nodiscard]] std::string cut_at(const CsvReader& reader, const std::string& lacks);

/// Names of contacts to their places; a name that is none: FileError for this file and line.
class ContactNames {
 public:
  explicit ContactNames(const Model& model);
  [[nodiscard]] int at(const std::string& name, const std::filesystem::path& file, int line) const;

 private:
  std::map<std::string, int> places_;
};

}  // namespace signorini
