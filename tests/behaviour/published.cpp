// The numbers of validation/published: printed ones against their closed forms, every engine against both.
#include <doctest/doctest.h>

#include <algorithm>

#include "published/figure.hpp"

using namespace signorini::published;

namespace {

double allowed(const Case& c, const std::string& engine) {
  return engine == "exact" ? 1e-10 : engine == "ida" ? c.ida : c.newmark;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/published");

TEST_CASE("closed forms of published cases through every engine") {
  for (const Case& c : all_cases()) {
    CAPTURE(c.name);
    const std::vector<Figure> figures = c.figures();
    for (const std::string engine : {"ida", "exact", "newmark"}) {
      CAPTURE(engine);
      const std::vector<double> ours = c.ours({engine, c.dt});
      REQUIRE(ours.size() == figures.size());
      for (std::size_t i = 0; i < figures.size(); ++i) {
        CAPTURE(figures[i].what);
        if (figures[i].compared)
          CHECK(error(figures[i], ours[i]) <= std::max(figures[i].mesh, allowed(c, engine)));
      }
    }
  }
}

TEST_CASE("printed numbers are those of the closed forms, but for the ones that the page names") {
  std::size_t printed = 0, off = 0;
  for (const Case& c : all_cases())
    for (const Figure& figure : c.figures()) {
      printed += !figure.printed.empty();
      off += last_digits_off(figure) > 1.0;
    }
  CHECK(printed == 34);
  CHECK(off == 7);
}

TEST_CASE("how far a printed number is off is counted in its last digit") {
  const Figure turn{"uy", "-4.596e-4", -4.59619407771256e-4L};
  CHECK(last_digits_off(turn) < 0.5);
  const Figure moved{"uy", "-4.596e-4", -4.59619407771256e-4L + 1e-7L};
  CHECK(last_digits_off(moved) == doctest::Approx(0.81).epsilon(0.01));
  CHECK(error(turn, -4.6e-4) == doctest::Approx(8.28e-4).epsilon(1e-2));
}

TEST_SUITE_END();
