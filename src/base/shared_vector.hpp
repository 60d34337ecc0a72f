// shared_vector.hpp: a vector whose copies share what none of them has changed since.
//
//   a, b = a copy of a;  b.set(i, x)        of the two only the piece with place i is another one
//
// Pieces are never written to once they are there: copies may be read by several threads.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace signorini {

/// piece: places that are copied with one that changes.
template <class T, std::size_t piece = 16>
class SharedVector {
 public:
  SharedVector() = default;
  explicit SharedVector(std::size_t size, const T& value = T())
      : size_(size), pieces_((size + piece - 1) / piece, filled(value)) {}

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return (*pieces_[i / piece])[i % piece]; }
  void set(std::size_t i, T value) {
    auto other = std::make_shared<Piece>(*pieces_[i / piece]);
    (*other)[i % piece] = std::move(value);
    pieces_[i / piece] = std::move(other);
  }

 private:
  using Piece = std::array<T, piece>;
  [[nodiscard]] static std::shared_ptr<const Piece> filled(const T& value) {
    auto result = std::make_shared<Piece>();
    result->fill(value);
    return result;
  }

  std::size_t size_ = 0;
  std::vector<std::shared_ptr<const Piece>> pieces_;
};

}  // namespace signorini
