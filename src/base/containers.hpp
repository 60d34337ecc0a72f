// containers.hpp: a bounded cache, disjoint sets, and a copy-on-write vector.
#pragma once

#include <algorithm>
#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace signorini::base {

/// Largest number of entries of a cache, and their largest total size in bytes.
struct CacheLimits {
  std::size_t count = 0, bytes = 0;
};

// Cache of limited number of entries and size, which removes the least recently used entries.
//
//   if (Value* known = cache.find(key)) use(*known); else use(cache.insert(key, make(key), bytes));
//
// If a limit is exceeded, the least recently used entries are removed first. The entry inserted last always stays, even if it
// alone exceeds the limit. A reference to a value is valid until the next insert.

template <class Key, class Value>
class LruCache {
 public:
  explicit LruCache(CacheLimits most) : most_(most) {}
  // Copying is forbidden, because the iterators in the index refer to this list.
  LruCache(const LruCache&) = delete;
  LruCache& operator=(const LruCache&) = delete;

  /// Value of the key; nullptr if the key is absent. The key becomes the most recently used one.
  [[nodiscard]] Value* find(const Key& key) {
    const auto known = index_.find(key);
    if (known == index_.end()) return nullptr;
    entries_.splice(entries_.begin(), entries_, known->second);
    return &known->second->value;
  }
  /// Inserts a key that is not in the cache. bytes: memory of key and value in addition to sizeof(Key) and sizeof(Value).
  Value& insert(const Key& key, Value value, std::size_t bytes) {
    entries_.push_front({std::move(value), bytes + entry_overhead, {}});
    entries_.front().place = index_.emplace(key, entries_.begin()).first;
    bytes_ += bytes + entry_overhead;
    while (entries_.size() > 1 && (entries_.size() > most_.count || bytes_ > most_.bytes)) {
      bytes_ -= entries_.back().bytes;
      index_.erase(entries_.back().place);
      entries_.pop_back();
    }
    return entries_.front().value;
  }
  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  struct Entry;
  using Entries = std::list<Entry>;
  using Index = std::map<Key, typename Entries::iterator>;
  struct Entry {
    Value value;
    std::size_t bytes;
    typename Index::iterator place;
  };
  /// Memory of one node of the list and one node of the index: their contents, and about four pointers in each node.
  static constexpr std::size_t entry_overhead =
      sizeof(Entry) + sizeof(typename Index::value_type) + 8 * sizeof(void*);
  CacheLimits most_;
  Entries entries_;  // entries, most recently used first
  Index index_;
  std::size_t bytes_ = 0;
};

// Connected components of the numbers 0 .. n-1, from pairs of connected numbers (union-find).
//
//   DisjointSets sets(n);
//   sets.join(i, j);
//   sets.find(i) == sets.find(j)
//
// Cost: nearly linear in the number of pairs (Tarjan 1975).

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// The smallest member of the set that contains i.
  [[nodiscard]] std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Unites the sets of i and j.
  void join(std::size_t i, std::size_t j) {
    i = find(i);
    j = find(j);
    (i < j ? parent_[j] : parent_[i]) = i < j ? i : j;
  }
  /// All sets, ordered by their smallest members; members ascending.
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

// A vector whose copies share unchanged pieces of memory (copy on write).
//
//   b = a;  b.set(i, x)        copies only the piece that contains element i
//
// Pieces are never written after their creation, so copies may be read by several threads.

/// piece: number of elements that are copied together when one of them changes; the last piece may be smaller.
template <class T, std::size_t piece = 16>
class CopyOnWriteVector {
 public:
  CopyOnWriteVector() = default;
  explicit CopyOnWriteVector(std::size_t size, const T& value = T()) : size_(size) {
    if (size >= piece) pieces_.assign(size / piece, std::make_shared<T[]>(piece, value));
    if (size % piece > 0) pieces_.push_back(std::make_shared<T[]>(size % piece, value));
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return pieces_[i / piece][i % piece]; }
  void set(std::size_t i, T value) {
    std::shared_ptr<const T[]>& mine = pieces_[i / piece];
    const std::size_t length = std::min(piece, size_ - i / piece * piece);
    auto other = std::make_shared<T[]>(length);
    std::copy_n(mine.get(), length, other.get());
    other[i % piece] = std::move(value);
    mine = std::move(other);
  }

 private:
  std::size_t size_ = 0;
  std::vector<std::shared_ptr<const T[]>> pieces_;
};

}  // namespace signorini::base
