// Numbers as text, suggestions, the table of keys.
#include <doctest/doctest.h>

#include <limits>
#include <set>
#include <string>

#include "base/number.hpp"
#include "base/suggest.hpp"
#include "scene/keys.hpp"

using namespace signorini;

TEST_SUITE_BEGIN("unit/scene/base");

TEST_CASE("numbers read back exactly in the fewest digits") {
  CHECK(shortest(0.1) == "0.1");
  CHECK(shortest(100.0) == "100");
  CHECK(shortest(1e-8) == "1e-08");
  for (const double x : {0.1 + 0.2, 1.0 / 3.0, 5e-324, std::numeric_limits<double>::max(), -0.0}) {
    CHECK(parse_number(shortest(x)) == x);
  }
  CHECK(parse_number("+2.5e0") == 2.5);
  for (const char* text : {"", "1,5", "1.5 ", "abc", "+-1", "+"}) CHECK_FALSE(parse_number(text));
  CHECK(parse_integer("12") == 12);
  CHECK_FALSE(parse_integer("99999999999999999999"));
}

TEST_CASE("suggestions") {
  CHECK(edit_distance("friction", "frictoin") == 1);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(nearest("Friction", {"gap", "friction"}) == "friction");
  CHECK(nearest("colour", {"gap", "friction"}).empty());
  CHECK(suggestion("x", {"gap", "law"}) == "; known: gap, law");
  CHECK(suggestion("x", {}).empty());
}

TEST_CASE("the table of keys says everything about each key once") {
  std::set<std::string> seen;
  for (const Key& key : all_keys()) {
    const std::string path = std::string(key.table) + "." + std::string(key.name);
    INFO(path);
    CHECK(seen.insert(path).second);
    CHECK(key.meaning.ends_with('.'));
    CHECK_FALSE(describe_type(key).empty());
    CHECK((key.type == KeyType::choice) == !key.choices.empty());
  }
}

TEST_SUITE_END();
