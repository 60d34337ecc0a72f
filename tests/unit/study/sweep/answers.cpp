// What a run answers to the queries of a sweep.
#include <doctest/doctest.h>

#include <cmath>

#include "contact/contact_states.hpp"
#include "signorini/model.hpp"
#include "study/sweep/response_query.hpp"

using namespace signorini;

TEST_SUITE_BEGIN("unit/study/sweep/answers");

TEST_CASE("answers: a run that has not come to its end has none") {
  const Model model = build_model(parse_scene(R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 1.0
[nodes]
A = [0.0, 0.0]
[[masses]]
node = "A"
mass = 1.0
[[contacts]]
name = "floor"
node = "A"
law = "slider"
tangent = [1.0, 0.0]
normal_force = 10.0
friction = 0.5
[[output]]
name = "u"
kind = "displacement"
at = "A"
direction = [1.0, 0.0]
)",
                                              "test.toml"));
  std::vector<sweep::ResponseQuery> queries;
  for (const char* text : {"max:u", "min:u", "abs:u", "tmax:u", "tmin:u", "end:u", "residual:floor",
                           "count:slip", "impulse:floor"})
    queries.push_back(sweep::parse_query(text, model));
  sweep::QueryRecorder answers(queries, model);
  Sample sample;
  sample.contacts.resize(1);
  answers.sample(sample);
  Report report;
  report.response = {{2.0, -3.0, 1.0, 0.25, 0.75}};
  report.landings.resize(1);
  report.outcome.kind = Outcome::Kind::done;
  const std::vector<double> whole = answers.values(report);
  CHECK(whole == std::vector<double>{2.0, -3.0, 3.0, 0.25, 0.75, 1.0, 0.0, 0.0, 0.0});
  for (const Outcome::Kind kind : {Outcome::Kind::stopped, Outcome::Kind::interrupted}) {
    report.outcome.kind = kind;
    for (const double value : answers.values(report)) CHECK(std::isnan(value));
  }
}

TEST_CASE("answers: a contact's name may have an @") {
  Model model;
  model.contacts.resize(2);
  model.layout = contact::layout_of(model.contacts);
  model.contacts[0].name = "a@2";
  model.contacts[1].name = "b";
  CHECK(sweep::parse_query("residual:a@2", model).name == "a@2");
  CHECK(sweep::parse_query("impulse:a@2", model).number == 0);
  CHECK(sweep::parse_query("impulse:a@2@3", model).name == "a@2");
  CHECK(sweep::parse_query("impulse:a@2@3", model).number == 3);
  CHECK(sweep::parse_query("count:stick@a@2", model).name == "a@2");
  CHECK(sweep::parse_query("impulse:b@2", model).number == 2);
  CHECK_THROWS_AS((void)sweep::parse_query("residual:b@2", model), UsageError);
}

TEST_SUITE_END();
