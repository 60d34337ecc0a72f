// Every pair of features (validation/differential/pairs.hpp): a small cut of the table, and what the table notices.
#include <doctest/doctest.h>

#include <algorithm>

#include <fstream>
#include <iterator>

#include "differential/pairs.hpp"

using namespace signorini;
using namespace signorini::differential;

namespace {

using RowState = PairRow::State;

std::vector<Feature> features_called(const std::vector<std::string>& names) {
  std::vector<Feature> some;
  for (const Feature& feature : all_features())
    if (std::find(names.begin(), names.end(), feature.name) != names.end()) some.push_back(feature);
  REQUIRE(some.size() == names.size());
  return some;
}

/// No clock: a slow machine is no other table.
PairTable table_of(const std::vector<Feature>& features, PairSettings settings = {}) {
  settings.features = &features;
  settings.minutes = 1e6;
  settings.rounds = 1;
  settings.apart = false;
  settings.bounds.seconds = 1e6;
  return examine_pairs(settings);
}

/// Every rebound is a thousandth too fast.
class ReboundTooFast final : public run::FaultInjector {
  bool change(const contact::ContactStates& /*before*/, const Vector& v, decide::Decision& decided) override {
    if (std::none_of(decided.impulses.begin(), decided.impulses.end(),
                     [](const decide::Impulse& impulse) { return impulse.hit; }))
      return false;
    decided.v += 1e-3 * (decided.v - v);
    return true;
  }
};

}  // namespace

TEST_SUITE_BEGIN("behaviour/pairs");

TEST_CASE("every pair of some features is checked or refused") {
  const std::vector<Feature> some =
      features_called({"law slider", "stop, compliant", "friction, static above kinetic", "restitution",
                       "gap", "load, jump", "matrices", "rigid body", "continued", "units", "sensitivity"});
  const PairTable table = table_of(some);
  REQUIRE(table.rows().size() == some.size() * (some.size() - 1) / 2);
  for (const PairRow& row : table.rows()) {
    CAPTURE(row.a->name);
    CAPTURE(row.b->name);
    CAPTURE(row.what);
    CHECK((row.state == RowState::checked || row.state == RowState::refused || row.state == RowState::open));
    CHECK((row.scenes > 0) == (row.state != RowState::refused));
  }
  CHECK(table.exit_code() == 0);
}

TEST_CASE("an error of one feature is a row that fails, and only rows of it fail") {
  const std::vector<Feature> some =
      features_called({"restitution", "friction, constant", "load, jump", "law slider"});
  PairSettings settings;
  settings.planted = [](const Feature& a, const Feature& b) -> std::function<SeenRun(const Scene&)> {
    const std::string of = "restitution";
    if (a.name != of && b.name != of) return {};
    return [](const Scene& scene) {
      ReboundTooFast faults;
      return see_injected(scene, {20000, 1e6}, faults);
    };
  };
  const PairTable table = table_of(some, settings);
  for (const PairRow& row : table.rows()) {
    CAPTURE(row.a->name);
    CAPTURE(row.b->name);
    CAPTURE(row.what);
    const bool has_error =
        std::string(row.a->name) == "restitution" || std::string(row.b->name) == "restitution";
    CHECK(row.state == (has_error ? RowState::failed : RowState::checked));
  }
  CHECK(table.exit_code() == 1);
}

TEST_CASE("a feature that no scene can have is a row with nothing") {
  std::vector<Feature> some = features_called({"law rigid", "gap"});
  some.push_back(
      {"law unheard of", "", 2, {}, Check::related, [](Draft&) { return std::string("nobody knows it"); }});
  // One that the program refuses, and no document says so.
  some.push_back({"key unheard of", "", 2, {}, Check::related, [](Draft& d) {
                    d.top.set("colour", "3.0");
                    return std::string();
                  }});
  const PairTable table = table_of(some);
  CHECK(table.row("law rigid", "gap")->state == RowState::checked);
  for (const char* unheard : {"law unheard of", "key unheard of"})
    for (const char* other : {"law rigid", "gap"})
      CHECK(table.row(unheard, other)->state == RowState::nothing);
  CHECK(table.row("gap", "law unheard of")->what == "nobody knows it");
  CHECK(table.count(RowState::nothing) == 5);
  CHECK(table.exit_code() == 1);
}

TEST_CASE("what is refused stands in the documents") {
  for (const PairRefusal& row : all_refusals()) {
    std::ifstream file(std::string(SIGNORINI_MODELS) + "/../" + row.doc);
    std::string text{std::istreambuf_iterator<char>(file), {}};
    for (char& c : text)
      if (c == '\n') c = ' ';
    CAPTURE(row.doc);
    CAPTURE(row.line);
    CHECK(text.find(row.line) != std::string::npos);
  }
}

TEST_CASE("refusals and open defects name features") {
  const auto known = [](const std::string& name) {
    return name == "*" || std::any_of(all_features().begin(), all_features().end(),
                                      [&](const Feature& f) { return name == f.name; });
  };
  for (const PairRefusal& row : all_refusals()) CHECK((known(row.a) && known(row.b)));
  for (const OpenDefect& row : open_defects()) CHECK((known(row.a) && known(row.b) && row.reason[0] != '\0'));
}

TEST_SUITE_END();
