#include "model/assembly/seam_ties.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "base/rounding.hpp"
#include "scene/components.hpp"

namespace signorini {
namespace {

[[noreturn]] void refuse_tie(const TieSpec& tie, const DofMap& map, const std::string& why) {
  throw SceneError(tie.place, fmt::format("seams.{}.slave", tie.seam),
                   fmt::format("node '{}' follows the master of this tied seam, and {}",
                               map.mesh.node(tie.node).name, why));
}

/// Terms of component c that a tied node follows; terms that cancel to rounding are left out.
std::vector<TiedTerm> followed(const TieSpec& tie, std::size_t c, const DofMap& map) {
  struct Sum {
    TiedTerm term;
    double size = 0.0;
  };
  std::vector<Sum> sums;
  for (const auto& [l, weight] : tie.master)
    for (const TiedTerm& term : map.terms(map.numbers_at(l)[c])) {
      const double part = weight * term.factor;
      const auto same =
          std::find_if(sums.begin(), sums.end(), [&](const Sum& s) { return s.term.number == term.number; });
      if (same == sums.end()) {
        sums.push_back({{term.number, part}, std::abs(part)});
      } else {
        same->term.factor += part;
        same->size += std::abs(part);
      }
    }
  std::vector<TiedTerm> terms;
  for (const Sum& s : sums)
    if (std::abs(s.term.factor) > rounding::of_few * s.size) terms.push_back(s.term);
  return terms;
}

}  // namespace

void leave_to_master(const Scene& scene, DofMap& map) {
  std::unordered_set<int> slaves;
  for (const TieSpec& tie : scene.ties) slaves.insert(tie.node);
  for (const TieSpec& tie : scene.ties) {
    const auto node = static_cast<std::size_t>(tie.node);
    if (map.body[node] >= 0)
      refuse_tie(tie, map,
                 fmt::format("is part of rigid body '{}'",
                             scene.rigid[static_cast<std::size_t>(map.body[node])].name));
    for (const std::size_t c : {std::size_t(0), std::size_t(1)}) {
      if (map.number[node][c] == DofMap::fixed || map.moving[node][c] >= 0)
        refuse_tie(tie, map, "a support holds it: expected supports on the master, or the two exchanged");
      map.number[node][c] = DofMap::absent;
    }
    for (const auto& [l, weight] : tie.master)
      if (slaves.contains(l))
        refuse_tie(tie, map, fmt::format("node '{}' of that master is tied itself", map.mesh.node(l).name));
  }
}

void tie_seams(const Scene& scene, DofMap& map) {
  for (const TieSpec& tie : scene.ties)
    for (const std::size_t c : {std::size_t(0), std::size_t(1)}) {
      std::vector<TiedTerm> terms = followed(tie, c, map);
      if (terms.empty())
        map.number[static_cast<std::size_t>(tie.node)][c] = DofMap::fixed;
      else
        map.tie(tie.node, c, std::move(terms));
    }
}

}  // namespace signorini
