// pair_checks.hpp: one scene of two features held against something that can notice.
//
//   related      relations of relation.hpp, and the engines of judge.hpp
//   commands     pair_commands.hpp
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "differential/features.hpp"
#include "differential/seen_run.hpp"

namespace signorini::differential {

struct Checked {
  enum class Kind {
    held,     ///< as it has to be
    broken,   ///< not so
    refused,  ///< by the program
    idle      ///< nothing could be compared
  } kind = Kind::idle;
  std::string how;   ///< "permuted", "engines", "derivatives", ...
  std::string what;  ///< what is broken, the message, why not
};

struct CheckRequest {
  std::string text;
  std::uint64_t seed = 1;
  std::vector<Check> checks;  ///< of the features; none: related
  std::string parameter;      ///< a key of one of the features, for derivatives; empty: none
  int relations = 2;          ///< so many of them
  std::string only;           ///< this relation alone
  Bounds bounds = {20000, 5.0};
  /// Of a related run, in place of its own: errors that are planted.
  std::function<SeenRun(const Scene&)> planted = {};
};

/// One a check that was made, the refusal of the scene alone where it is refused.
[[nodiscard]] std::vector<Checked> check_scene(const CheckRequest& request);
/// The same in a process of its own: one that ends by a signal, or not at all, is broken.
[[nodiscard]] std::vector<Checked> check_scene_apart(const CheckRequest& request);

}  // namespace signorini::differential
