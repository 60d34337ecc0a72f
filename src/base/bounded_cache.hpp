// bounded_cache.hpp: least-recently-used cache with bounded count and size.
//
//   if (Value* known = cache.find(key)) use(*known); else use(cache.insert(key, make(key), bytes));
//
// Bounded by number of entries and by bytes: the least recently used entry is removed first. The last inserted entry
// always stays, whatever its size. References are valid until the next insert.
#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <utility>

namespace signorini {

struct CacheBounds {
  std::size_t count = 0, bytes = 0;
};

template <class Key, class Value>
class BoundedCache {
 public:
  explicit BoundedCache(CacheBounds most) : most_(most) {}
  // The index refers to the list.
  BoundedCache(const BoundedCache&) = delete;
  BoundedCache& operator=(const BoundedCache&) = delete;

  /// nullptr if the key is absent.
  [[nodiscard]] Value* find(const Key& key) {
    const auto known = index_.find(key);
    if (known == index_.end()) return nullptr;
    entries_.splice(entries_.begin(), entries_, known->second);
    return &known->second->value;
  }
  /// key: must be absent. bytes: memory of key and value in addition to their own sizes.
  Value& insert(const Key& key, Value value, std::size_t bytes) {
    entries_.push_front({std::move(value), bytes + each, {}});
    entries_.front().place = index_.emplace(key, entries_.begin()).first;
    bytes_ += bytes + each;
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
  /// Size of the nodes of list and index: their contents, and about four words each of links.
  static constexpr std::size_t each = sizeof(Entry) + sizeof(typename Index::value_type) + 8 * sizeof(void*);
  CacheBounds most_;
  Entries entries_;  // most recently used first
  Index index_;
  std::size_t bytes_ = 0;
};

}  // namespace signorini
