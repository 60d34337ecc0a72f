#include "base/containers.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace signorini;

TEST_SUITE_BEGIN("unit/base/containers");

TEST_CASE("what one copy changes no other sees, and all that is not changed stands at one place") {
  base::CopyOnWriteVector<std::string, 4> a(10, "x");
  REQUIRE(a.size() == 10);
  a.set(9, "last");
  const base::CopyOnWriteVector<std::string, 4> b = a;
  base::CopyOnWriteVector<std::string, 4> c = a;
  c.set(5, "y");
  a.set(4, "z");
  for (std::size_t i = 0; i < 10; ++i) {
    CAPTURE(i);
    CHECK(a[i] == (i == 4 ? "z" : i == 9 ? "last" : "x"));
    CHECK(b[i] == (i == 9 ? "last" : "x"));
    CHECK(c[i] == (i == 5 ? "y" : i == 9 ? "last" : "x"));
    const bool in_changed_piece = i >= 4 && i < 8;
    CHECK((&a[i] == &b[i]) == !in_changed_piece);
    CHECK((&c[i] == &b[i]) == !in_changed_piece);
  }
}

TEST_CASE("sizes about a whole number of pieces") {
  for (std::size_t size = 0; size <= 9; ++size) {
    base::CopyOnWriteVector<int, 4> a(size, 7);
    REQUIRE(a.size() == size);
    for (std::size_t i = 0; i < size; ++i) a.set(i, static_cast<int>(i));
    for (std::size_t i = 0; i < size; ++i) CHECK(a[i] == static_cast<int>(i));
  }
  CHECK(base::CopyOnWriteVector<int>().size() == 0);
}

TEST_SUITE_END();
