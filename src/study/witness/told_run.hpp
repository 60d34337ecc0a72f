// told_run.hpp: results in summary.json and events.csv of a run, for the witness.
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
  bool stopped = false;  ///< it stopped before t_end
  double t = 0.0;        ///< time reached
  long total = 0;        ///< number of events
  std::map<std::string, long> events_by_type;
  /// Extremes of each contact; empty for an older run.
  struct Load {
    double least_N = 0.0, greatest_N = 0.0, least_T = 0.0, greatest_T = 0.0;
  };
  std::vector<std::optional<Load>> loads;
  std::vector<std::optional<Peak>> peaks;  ///< one per contact
};
/// Errors: FileError.
[[nodiscard]] ToldSummary told_summary(const std::filesystem::path& directory, const Model& model);

/// All rows of events.csv; user-law states are given as their kinds. ended: a last line without its line break then is
/// an error. Errors: FileError.
[[nodiscard]] std::vector<Event> told_events(const std::filesystem::path& directory, const Model& model,
                                             bool ended);

/// Message for a table that ends too early: the line of its end, and the missing part.
[[nodiscard]] std::string cut_at(const CsvReader& reader, const std::string& lacks);

/// Index of a contact by name; an unknown name is a FileError for this file and line.
class ContactNames {
 public:
  explicit ContactNames(const Model& model);
  [[nodiscard]] int at(const std::string& name, const std::filesystem::path& file, int line) const;

 private:
  std::map<std::string, int> places_;
};

}  // namespace signorini
