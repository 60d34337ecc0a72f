#include "certify/error_bounds.hpp"
#include "contact/contact_states.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace signorini::tests::bounds_tests {
namespace {

/// One degree of freedom: its u, its v, and N of a contact.
Model one_mass() {
  Model model;
  model.dofs.resize(1);
  model.columns = {{"d0.u", 0, false}, {"d0.v", 0, true}};
  model.contacts.resize(1);
  model.layout = contact::layout_of(model.contacts);
  return model;
}

certify::RecordedRows kept_rows(std::size_t count, double off) {
  certify::RecordedRows kept;
  kept.width = 4;
  for (std::size_t i = 0; i < count; ++i) {
    const auto t = static_cast<double>(i);
    kept.t.push_back(t);
    // off by 0 but in row 2
    const double more = i == 2 ? off : 0.0;
    for (const double x : {1.0 + more, 3.0 * t * t - more, 10.0 - t, 0.0}) kept.values.push_back(x);
  }
  return kept;
}

}  // namespace

TEST_SUITE_BEGIN("unit/certify/error_bounds");

TEST_CASE(
    "bounds: the greatest difference of the last five rows, one tolerance, and what jumps at an event") {
  const Model model = one_mass();
  const certify::RecordedRows own = kept_rows(10, 0.0), near = kept_rows(10, 1e-3),
                              far = kept_rows(12, -2e-3);
  const Report report;
  certify::BoundSettings settings;
  settings.factor = 2.0;
  settings.tolerance = {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1};
  certify::TimedEvent event;
  event.t = 6.0;
  event.contact = 0;
  event.type = EventType::slip;
  certify::MatchResult verdict;
  verdict.t_errors = {0.5};
  const HistoryErrors errors = certify::bound_history(
      model, {&own, &report}, {{&near, &report}, {&far, &report}}, settings, {event}, verdict);
  REQUIRE(errors.t.size() == 10);
  const auto bound = [&](std::size_t row, std::size_t column) { return errors.bounds[row * 4 + column]; };
  for (std::size_t row = 0; row < 10; ++row) {
    CAPTURE(row);
    const double off = row >= 2 && row < 7 ? 2.0 * 2e-3 : 0.0;
    CHECK(bound(row, 0) == doctest::Approx(off + 1e-6 + 1e-5).epsilon(1e-12));
    const double jump = row == 6 ? 3.0 * (36.0 - 25.0) + 3.0 * (49.0 - 36.0) : 0.0;
    CHECK(bound(row, 1) == doctest::Approx(off + 1e-6 * 243.0 + 1e-3 + jump).epsilon(1e-12));
    CHECK(bound(row, 2) == doctest::Approx(1e-6 * 10.0 + 1e-1 + (row == 6 ? 2.0 : 0.0)).epsilon(1e-12));
  }
}

TEST_CASE("bounds: none from where nothing is certain, and roundings alone where steps have no tolerance") {
  const Model model = one_mass();
  const certify::RecordedRows own = kept_rows(10, 0.0), other = kept_rows(7, 0.0);
  const Report report;
  certify::MatchResult verdict;
  verdict.until = 4.5;
  verdict.reason = "a partner is missing";
  const HistoryErrors errors =
      certify::bound_history(model, {&own, &report}, {{&other, &report}}, {}, {}, verdict);
  REQUIRE(errors.t.size() == 7);
  for (std::size_t row = 0; row < 7; ++row) {
    const double bound = errors.bounds[row * 4];
    CHECK(std::isinf(bound) == (row > 4));
    if (row <= 4) CHECK(bound < 1e-13);
    if (row <= 4) CHECK(bound > 1e-17);
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::bounds_tests
