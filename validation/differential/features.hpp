// features.hpp: what changes the motion of a scene or how it is computed, one row each.
//
//   name       of its row and column in the table of pairs
//   group      features of one group are values of one key: a scene has one of them
//   rank       structure adds itself first, then what only one law can have, then what any can
//   kit        the structure that it needs; absent: any
//   check      what it is held against, where that is not a related run
//   add        adds it to a scene, or says why it cannot; empty: it is added
//
// What the program refuses by name is a row of refusals, with the line of the documents that says so. What is known to be wrong
// is a row of open defects.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "differential/draft.hpp"

namespace signorini::differential {

/// What stands beside a scene.
enum class Check {
  related,      ///< relations, and other engines
  going_on,     ///< the same motion in two runs
  in_units,     ///< the scene in other units
  derivatives,  ///< sensitivities beside differences of runs
  orbit,        ///< a period of another engine, and the orbit of a related scene
  sweep,        ///< rows beside related runs
  verify,       ///< Newmark at three steps
};

struct Feature {
  const char* name;
  const char* group;  ///< "": it stands beside all others
  int rank;
  std::optional<Kit> kit;
  Check check;
  std::string (*add)(Draft&);
  bool needs_nodes = false;  ///< it is not for [matrices], which are refused beside it
};
[[nodiscard]] const std::vector<Feature>& all_features();

/// Two values of one key.
[[nodiscard]] bool are_alternatives(const Feature& a, const Feature& b);

/// A scene with both; empty: `why` says what is in the way. beside: so many other features, as far as they fit.
struct PairScene {
  std::string text, why, parameter;
};
[[nodiscard]] PairScene draw_pair(const std::vector<Feature>& features, const Feature& a, const Feature& b,
                                  std::uint64_t seed, int beside);

/// a, b: names, "*" for any.
struct PairRefusal {
  const char *a, *b;
  const char* says;        ///< part of the message
  const char *doc, *line;  ///< where the documents say so, and what stands there
};
[[nodiscard]] const std::vector<PairRefusal>& all_refusals();

struct OpenDefect {
  const char* name;
  const char *a, *b;  ///< names, "*" for any
  const char* how;    ///< part of the check's name; "": any
  const char* shows;  ///< part of what it says; "": any
  const char* reason;
};
[[nodiscard]] const std::vector<OpenDefect>& open_defects();

}  // namespace signorini::differential
