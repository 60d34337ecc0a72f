// disjoint_sets.hpp: connected components of 0 .. n-1, from connected pairs (union-find).
//
//   DisjointSets sets(n);
//   sets.join(i, j);
//   sets.find(i) == sets.find(j)
//
// Nearly linear in the number of pairs (Tarjan 1975).
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace signorini {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// The smallest member of i's set.
  [[nodiscard]] std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t i, std::size_t j) {
    i = find(i);
    j = find(j);
    (i < j ? parent_[j] : parent_[i]) = i < j ? i : j;
  }
  /// The sets in the order of their smallest members, members ascending.
  [[nodiscard]] std::vector<std::vector<std::size_t>> sets() {
    std::vector<std::vector<std::size_t>> result;
    std::vector<std::size_t> number(parent_.size());
    for (std::size_t i = 0; i < parent_.size(); ++i) {
      const std::size_t root = find(i);
      if (root == i) {
        number[i] = result.size();
        result.emplace_back();
      }
      result[number[root]].push_back(i);
    }
    return result;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace signorini
