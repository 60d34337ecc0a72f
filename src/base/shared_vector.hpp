// shared_vector.hpp: a copy-on-write vector whose copies share unchanged pieces.
//
//   a, b = a copy of a;  b.set(i, x)        only the piece that contains i is copied
//
// Pieces are never written after their creation, so copies may be read by several threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace signorini {

/// piece: number of elements that are copied together with a changed one; the last piece may be smaller.
template <class T, std::size_t piece = 16>
class SharedVector {
 public:
  SharedVector() = default;
  explicit SharedVector(std::size_t size, const T& value = T()) : size_(size) {
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

}  // namespace signorini
