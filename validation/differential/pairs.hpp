// pairs.hpp: every pair of features in random scenes, each held against something that can notice.
//
//   PairTable table = examine_pairs({});
//   table.print();   return table.exit_code();
//
//   checked       scenes with both ran, and all that they were held against agreed
//   refused       the program refuses the two together by name, as the documents say (features.hpp)
//   alternatives  two values of one key
//   open          what is known to be wrong and not mended yet (features.hpp)
//   FAILED        a scene disagrees: a new finding
//   NOTHING       no scene of them was held against anything
//   not reached   time was up before its first scene
#pragma once

#include <map>

#include "differential/pair_checks.hpp"

namespace signorini::differential {

struct PairSettings {
  std::uint64_t from = 1;         ///< seed
  double minutes = 60.0;          ///< no scene begins later
  int rounds = 1000;              ///< scenes of each pair, as far as time goes
  int tries = 16;                 ///< scenes until the first that is held against something
  std::vector<std::string> only;  ///< pairs with one of these features, of two names this pair; empty: all
  std::string keep;               ///< directory of what disagrees; empty: none
  bool shrink = false;
  bool verbose = false;  ///< a line a scene
  bool apart = true;     ///< each scene in a process of its own
  Bounds bounds = {20000, 5.0};
  const std::vector<Feature>* features = nullptr;  ///< nullptr: all_features()
  /// Of a related run of a scene with this pair: errors that a test plants; an empty function: none.
  std::function<std::function<SeenRun(const Scene&)>(const Feature& a, const Feature& b)> planted = {};
};

struct PairRow {
  enum class State { checked, refused, alternatives, open, failed, nothing, not_reached };
  const Feature *a = nullptr, *b = nullptr;
  State state = State::not_reached;
  long scenes = 0;                  ///< with both, that something was held against
  std::map<std::string, long> how;  ///< scenes by what they were held against
  std::string what;                 ///< the documents' line, the defect, the difference, why nothing
  std::size_t place = 0;            ///< among all pairs: its scenes are the same in every cut
};
[[nodiscard]] const char* to_string(PairRow::State state);

class PairTable {
 public:
  explicit PairTable(std::vector<PairRow> rows) : rows_(std::move(rows)) {}
  [[nodiscard]] const std::vector<PairRow>& rows() const { return rows_; }
  [[nodiscard]] long count(PairRow::State state) const;
  [[nodiscard]] const PairRow* row(const std::string& a, const std::string& b) const;
  void print() const;
  /// 1 where a pair has failed, or has nothing.
  [[nodiscard]] int exit_code() const;

 private:
  std::vector<PairRow> rows_;
};

[[nodiscard]] PairTable examine_pairs(const PairSettings& settings);

}  // namespace signorini::differential
