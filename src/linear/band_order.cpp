#include "linear/band_order.hpp"

#include <algorithm>
#include <set>

namespace signorini {
namespace {

using Neighbours = std::vector<std::vector<int>>;

Neighbours neighbours_of(const Model& model, const Structure& structure) {
  std::vector<std::set<int>> sets(static_cast<std::size_t>(structure.size));
  const auto couple = [&](int i, int j) {
    if (i == j) return;
    sets[static_cast<std::size_t>(i)].insert(j);
    sets[static_cast<std::size_t>(j)].insert(i);
  };
  for (int j = 0; j < structure.size; ++j)
    for (auto p = structure.column_start[static_cast<std::size_t>(j)];
         p < structure.column_start[static_cast<std::size_t>(j) + 1]; ++p)
      couple(structure.row[static_cast<std::size_t>(p)], j);
  for (const Contact& contact : model.contacts) {
    std::vector<int> dofs;
    for (const Combination* form : {&contact.normal, &contact.tangent})
      for (const auto& term : form->terms) dofs.push_back(term.first);
    for (const int i : dofs)
      for (const int j : dofs) couple(i, j);
  }
  Neighbours result;
  for (const std::set<int>& set : sets) result.emplace_back(set.begin(), set.end());
  return result;
}

/// Connected component of `first`, level by level; `seen` marks it.
std::vector<int> levels_from(int first, const Neighbours& neighbours, std::vector<bool>& seen) {
  std::vector<int> order{first};
  seen[static_cast<std::size_t>(first)] = true;
  for (std::size_t next = 0; next < order.size(); ++next) {
    const std::size_t begin = order.size();
    for (const int j : neighbours[static_cast<std::size_t>(order[next])]) {
      if (seen[static_cast<std::size_t>(j)]) continue;
      seen[static_cast<std::size_t>(j)] = true;
      order.push_back(j);
    }
    std::stable_sort(order.begin() + static_cast<std::ptrdiff_t>(begin), order.end(), [&](int a, int b) {
      return neighbours[static_cast<std::size_t>(a)].size() < neighbours[static_cast<std::size_t>(b)].size();
    });
  }
  return order;
}

}  // namespace

BandOrder band_order(const Model& model, const Structure& structure) {
  const Neighbours neighbours = neighbours_of(model, structure);
  const std::size_t n = neighbours.size();
  BandOrder result{std::vector<int>(n, 0), 0};
  std::vector<bool> placed(n, false);
  int next = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (placed[i]) continue;
    int end = static_cast<int>(i);
    for (int turn = 0; turn < 2; ++turn) {
      std::vector<bool> seen = placed;
      end = levels_from(end, neighbours, seen).back();
    }
    for (const int j : levels_from(end, neighbours, placed))
      result.place[static_cast<std::size_t>(j)] = next++;
  }
  for (std::size_t i = 0; i < n; ++i)
    for (const int j : neighbours[i]) {
      const int apart = result.place[i] - result.place[static_cast<std::size_t>(j)];
      result.width = std::max(result.width, static_cast<std::size_t>(std::max(apart, -apart)));
    }
  return result;
}

}  // namespace signorini
