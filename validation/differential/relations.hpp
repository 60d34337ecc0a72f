// relations.hpp: the campaign: scenes from seeds, each beside its related ones.
//
//   RelationTally tally;
//   for (seed ...) campaign_of_relations(draw_whole_scene(seed), "seed-7", {}, {}, tally);
//   tally.print();
#pragma once

#include <functional>

#include "differential/relation_judge.hpp"

namespace signorini::differential {

struct RelationSettings {
  std::uint64_t seed = 1;  ///< of angles, orders, times
  std::string only;        ///< name of one relation; empty: all that apply
  long place = -1;         ///< of the one relation to take of those that apply, from this one on; -1: all
  bool peaks = true;       ///< of contacts
  Bounds bounds = {200000, 20.0};
};

class RelationTally {
 public:
  void add(const std::string& relation, const Likeness& found);
  /// Runs by relation and class.
  void print() const;
  [[nodiscard]] long runs() const { return runs_; }
  [[nodiscard]] long unexplained() const { return unexplained_; }
  [[nodiscard]] std::size_t events() const { return events_; }

 private:
  std::map<std::string, std::map<Likeness::Class, long>> counts_;
  long runs_ = 0, unexplained_ = 0;
  std::size_t events_ = 0;
};

/// Called with each relation that applies and what came of it.
using RelationReport =
    std::function<void(const char* relation, const Related& related, const Likeness& found)>;
void examine_relations(const std::string& text, const std::string& name, const RelationSettings& settings,
                       const RelationReport& report);

struct KeepSettings {
  std::string directory;  ///< for scenes that are not explained; empty: none
  bool shrink = false;
  bool all_lines = false;  ///< of what is explained, too
};

/// The same with a line for each that is not explained, counted and kept.
void campaign_of_relations(const std::string& text, const std::string& name, const RelationSettings& settings,
                           const KeepSettings& keep, RelationTally& tally);

}  // namespace signorini::differential
