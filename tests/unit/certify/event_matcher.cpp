// Lists of events made by hand: what is certain, until when, and why no further.
#include "certify/event_matcher.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace signorini;

namespace {

const std::vector<std::string> names = {"A", "B"};

/// Slips and sticks in turn; `row` counts them.
certify::TimedEvent event(double t, int contact, int row, float uncertainty = 0.0F) {
  const bool slips = row % 2 == 0;
  certify::TimedEvent e;
  e.t = t;
  e.uncertainty = uncertainty;
  e.contact = contact;
  e.type = slips ? EventType::slip : EventType::stick;
  e.from = slips ? State::stick : State::slip_plus;
  e.to = slips ? State::slip_plus : State::stick;
  e.is_located = true;
  return e;
}

certify::EventSequence track(const std::vector<double>& times, double reached = 100.0) {
  certify::EventSequence result{{}, reached, ""};
  for (std::size_t i = 0; i < times.size(); ++i)
    result.events.push_back(event(times[i], 0, static_cast<int>(i)));
  return result;
}

std::size_t certain(const certify::MatchResult& verdict) {
  return static_cast<std::size_t>(std::count_if(verdict.t_errors.begin(), verdict.t_errors.end(),
                                                [](double e) { return !std::isnan(e); }));
}

}  // namespace

TEST_SUITE_BEGIN("unit/certify/event_matcher");

TEST_CASE("judge: twice the difference, the uncertainty, and the rounding of the clock") {
  certify::EventSequence run = track({1.0, 2.0, 3.0});
  run.events[1].uncertainty = 0x1p-10F;
  const certify::MatchResult verdict =
      certify::match_events(run, {track({1.0, 2.0 + 0x1p-8, 3.0})}, 2.0, names);
  CHECK(verdict.reason.empty());
  CHECK(verdict.until == 100.0);
  CHECK_FALSE(verdict.first_uncertain);
  CHECK(verdict.t_errors[0] == 0x1p-51);
  CHECK(verdict.t_errors[1] == doctest::Approx(0x1p-7 + 0x1p-10).epsilon(1e-12));
  CHECK(verdict.t_errors[2] == doctest::Approx(0x1p-7).epsilon(1e-12));  // remembered
}

TEST_CASE("judge: what changes beside a guard that falls is as uncertain as its time") {
  certify::EventSequence run = track({1.0, 2.0});
  run.events.push_back(event(2.0, 1, 0, 0x1p-10F));
  run.events.push_back(event(3.0, 1, 1));
  const certify::MatchResult verdict = certify::match_events(run, {run}, 2.0, names);
  CHECK(verdict.t_errors[0] == 0x1p-51);
  CHECK(verdict.t_errors[1] == doctest::Approx(0x1p-10).epsilon(1e-12));
  CHECK(verdict.t_errors[2] == verdict.t_errors[1]);
  CHECK(verdict.t_errors[3] == doctest::Approx(3.0 * 0x1p-51));
}

TEST_CASE("judge: an uncertainty is rounded up") {
  for (const double x : {0.1, 0.3, 0.7, 1e-13}) {
    Event e;
    e.t_uncertainty = x;
    CHECK(static_cast<double>(certify::timed_event(e).uncertainty) >= x);
    CHECK(static_cast<double>(certify::timed_event(e).uncertainty) == doctest::Approx(x).epsilon(1e-6));
  }
}

TEST_CASE("judge: the greatest of five, and of several companions") {
  std::vector<double> times, near, far;
  for (int i = 1; i <= 12; ++i) {
    times.push_back(i);
    near.push_back(i == 3 ? i + 0x1p-6 : i);
    far.push_back(i == 3 ? i - 0x1p-5 : i);
  }
  const certify::MatchResult one = certify::match_events(track(times), {track(near)}, 1.0, names);
  const certify::MatchResult two = certify::match_events(track(times), {track(near), track(far)}, 1.0, names);
  for (std::size_t i = 0; i < 12; ++i) {
    CAPTURE(i);
    const bool counts = i >= 2 && i < 7;
    CHECK(one.t_errors[i] == doctest::Approx(counts ? 0x1p-6 : 0.0).epsilon(1e-10));
    CHECK(two.t_errors[i] == doctest::Approx(counts ? 0x1p-5 : 0.0).epsilon(1e-10));
  }
}

TEST_CASE("judge: an event without a partner ends it, on either side") {
  const certify::EventSequence longer = track({1.0, 2.0, 3.0, 4.0}), shorter = track({1.0, 2.0, 3.0});
  const certify::MatchResult missing = certify::match_events(longer, {shorter}, 2.0, names);
  CHECK(missing.until == 4.0);
  CHECK(certain(missing) == 3);
  CHECK(missing.first_uncertain == 3);
  CHECK(missing.reason.find("stick of 'A' at t = 4") != std::string::npos);
  const certify::MatchResult more = certify::match_events(shorter, {longer}, 2.0, names);
  CHECK(more.until == 4.0);
  CHECK(certain(more) == 3);
  CHECK_FALSE(more.first_uncertain);
  CHECK(more.reason.find("one more event") != std::string::npos);
  certify::EventSequence grazing = longer;
  grazing.events[3].uncertainty = 0.125F;  // it may be that much earlier, times c
  CHECK(certify::match_events(shorter, {grazing}, 2.0, names).until == 3.75);
  CHECK(certify::match_events(grazing, {shorter}, 2.0, names).until == 3.75);
}

TEST_CASE("judge: another state, or a partner that is nearer to its neighbour") {
  certify::EventSequence run = track({1.0, 2.0, 3.0}), other = run;
  other.events[1].to = State::open;
  CHECK(certify::match_events(run, {other}, 2.0, names).until == 2.0);
  CHECK(certify::match_events(run, {track({1.0, 2.0, 2.4})}, 1.0, names).until == doctest::Approx(2.4));
  CHECK(certify::match_events(run, {track({1.0, 2.0, 3.4})}, 1.0, names).until > 2.5);
  CHECK(certain(certify::match_events(run, {track({1.0, 2.0, 3.4})}, 1.0, names)) == 3);
}

TEST_CASE("judge: a shift that events share ends nothing, one that changes between them does") {
  const certify::EventSequence run = track({1.0, 2.0, 3.0, 3.1});
  const certify::MatchResult shared = certify::match_events(run, {track({1.0, 2.0, 3.2, 3.3})}, 2.0, names);
  CHECK(shared.reason.empty());
  CHECK(shared.t_errors[3] == doctest::Approx(0.4));
  const certify::MatchResult changes = certify::match_events(run, {track({1.0, 2.0, 3.0, 3.13})}, 2.0, names);
  CHECK(certain(changes) == 3);  // 2 x 0.03 > 0.1 / 2
  CHECK(changes.until == doctest::Approx(3.1));
  CHECK(changes.reason.find("has an error of 0.06") != std::string::npos);
}

TEST_CASE(
    "judge: events of a contact that follow each other by less than their own uncertainties are not "
    "certain") {
  for (const bool close : {false, true}) {
    certify::EventSequence run = track({1.0, 2.0, 2.5});
    run.events[1].uncertainty = 0x1p-3F;
    run.events[2].uncertainty = close ? 0x1.1p-3F : 0x1p-3F;  // half of the time between them is 0.25
    const certify::MatchResult verdict = certify::match_events(run, {run}, 2.0, names, true);
    CHECK(certain(verdict) == (close ? 2 : 3));
    CHECK(verdict.reason.empty() != close);
    CHECK(certify::match_events(run, {run}, 2.0, names).reason.empty());  // what a tolerance leaves is shared
  }
  certify::EventSequence at_once = track({1.0, 2.0, 2.0});
  for (certify::TimedEvent& e : at_once.events) e.uncertainty = 0x1p-3F;
  CHECK(certify::match_events(at_once, {at_once}, 2.0, names, true).reason.empty());
}

TEST_CASE("judge: what a companion of roundings does not tell apart itself is not certain") {
  const certify::EventSequence run = track({1.0, 2.0, 2.5});
  for (const bool close : {false, true}) {
    certify::EventSequence companion = run;
    companion.rounded = true;
    companion.events[1].uncertainty = 0x1p-3F;
    companion.events[2].uncertainty = close ? 0x1.1p-3F : 0x1p-3F;  // half of the time between them is 0.25
    const certify::MatchResult verdict = certify::match_events(run, {companion}, 2.0, names);
    CHECK(certain(verdict) == (close ? 2 : 3));
    CHECK(verdict.reason.empty() != close);
    companion.rounded = false;
    CHECK(certify::match_events(run, {companion}, 2.0, names).reason.empty());
  }
}

TEST_CASE("judge: what lies within its error of the horizon may lie beyond it") {
  certify::EventSequence run = track({1.0, 1.95});
  run.events.push_back(event(2.0, 1, 0));
  const certify::MatchResult verdict = certify::match_events(run, {track({1.05, 2.0})}, 1.0, names);
  CHECK(verdict.until == doctest::Approx(1.95));
  CHECK(certain(verdict) == 1);
  CHECK(verdict.first_uncertain == 1);
}

TEST_CASE("judge: an event that may lie beyond the horizon lies beyond the certain part") {
  certify::EventSequence run = track({1.0, 1.9}), other = run;
  run.events[1].uncertainty = 0.25F;
  run.events.push_back(event(2.0, 1, 0));  // without a partner
  const certify::MatchResult verdict = certify::match_events(run, {other}, 1.0, names);
  CHECK(verdict.first_uncertain == 1);
  CHECK(verdict.until == doctest::Approx(1.65).epsilon(1e-12));  // as early as it may be
  run.events[1].uncertainty = 4.0F;
  CHECK(certify::match_events(run, {other}, 1.0, names).until == 0.0);
}

TEST_CASE("judge: what a companion leaves open ends it, what the run leaves open does not") {
  certify::EventSequence run = track({1.0, 2.0, 3.0}), other = run;
  run.graze = events::Graze{1.5, 1, "separation"};
  CHECK(certain(certify::match_events(run, {other}, 2.0, names)) == 3);
  other.graze = events::Graze{2.5, 1, "separation"};
  const certify::MatchResult verdict = certify::match_events(run, {other}, 2.0, names);
  CHECK(verdict.until == 2.5);
  CHECK(certain(verdict) == 2);
  CHECK(verdict.reason.find("the separation of 'B' is zero within the companion's tolerance at t = 2.5") ==
        0);
}

TEST_CASE("judge: a companion that stopped certifies up to there") {
  certify::EventSequence other = track({1.0, 2.0}, 2.5);
  other.stop = "the companion stopped: it could not go on";
  const certify::MatchResult verdict = certify::match_events(track({1.0, 2.0, 3.0}), {other}, 2.0, names);
  CHECK(verdict.until == 2.5);
  CHECK(verdict.reason == other.stop);
  CHECK(certain(verdict) == 2);
}

TEST_CASE("judge: the order of different contacts is counted and ends nothing") {
  certify::EventSequence run, other;
  run.reached = other.reached = 10.0;
  run.events = {event(1.0, 0, 0), event(1.001, 1, 0), event(5.0, 0, 1), event(6.0, 1, 1)};
  other.events = {event(1.0005, 1, 0), event(1.0015, 0, 0), event(5.0, 0, 1), event(6.0, 1, 1)};
  const certify::MatchResult verdict = certify::match_events(run, {other}, 2.0, names);
  CHECK(verdict.reason.empty());
  CHECK(certain(verdict) == 4);
  CHECK(verdict.unordered == 1);
}

TEST_CASE("judge: jumps of loads are known, and leave what was remembered") {
  certify::EventSequence run = track({1.0, 2.0}), other = track({1.0 + 0x1p-10, 2.0});
  certify::TimedEvent jump;
  jump.t = 3.0;
  certify::TimedEvent thrown = event(3.0, 0, 2);
  thrown.is_located = false;
  for (certify::EventSequence* t : {&run, &other})
    t->events.insert(t->events.end(), {jump, thrown, event(4.0, 0, 3)});
  const certify::MatchResult verdict = certify::match_events(run, {other}, 2.0, names);
  CHECK(verdict.t_errors[2] == 2.0 * 0x1p-52 * 3.0);
  CHECK(verdict.t_errors[3] == 2.0 * 0x1p-52 * 3.0);
  CHECK(verdict.t_errors[4] == doctest::Approx(0x1p-9).epsilon(1e-10));
}

TEST_CASE("judge: rest or flight by less than the speed may be off is not certain, alike in both or not") {
  const auto leaving = [](double first, double second) {
    certify::EventSequence result = track({1.0, 2.0, 3.0});
    result.events[1].departure = first;
    result.events[2].departure = second;
    return result;
  };
  // Off by 2^-10 of itself, twice that counts.
  const double off = 0x1p-10;
  const certify::EventSequence companion = leaving(4.0 * (1.0 - off), 1.0 + 2.0 * off);
  CHECK(certify::match_events(leaving(4.0, 1.0 + 3.0 * off), {companion}, 2.0, names).reason.empty());
  const certify::MatchResult close =
      certify::match_events(leaving(4.0, 1.0 + 1.5 * off), {companion}, 2.0, names);
  CHECK(close.until == 3.0);
  CHECK(certain(close) == 2);
  CHECK(close.reason.find("times the least rebound speed") != std::string::npos);
  // Below one it rests: speeds far below are rounding, and may differ by any part of themselves.
  CHECK(certify::match_events(leaving(4.0, 1e-7), {leaving(4.0, 5e-9)}, 2.0, names).reason.empty());
  const certify::MatchResult rests =
      certify::match_events(leaving(4.0, 1.0 - 1.5 * off), {leaving(4.0, 1.0 - 2.5 * off)}, 2.0, names);
  CHECK(rests.until == 3.0);
}

TEST_CASE("judge: nothing is certain from where rounding left several states open, in either run") {
  certify::EventSequence run = track({1.0, 2.0, 3.0}), companion = run;
  run.first_undecided_t = 2.5;
  const certify::MatchResult own = certify::match_events(run, {companion}, 2.0, names);
  CHECK(own.until == 2.5);
  CHECK(certain(own) == 2);
  CHECK(own.reason.find("left several contact states") != std::string::npos);
  run.first_undecided_t.reset();
  companion.first_undecided_t = 1.5;
  CHECK(certify::match_events(run, {companion}, 2.0, names).until == 1.5);
}

TEST_CASE("judge: nothing is certain from where a witness objects, to either run") {
  certify::EventSequence run = track({1.0, 2.0, 3.0}), companion = run;
  run.first_violation = certify::EventSequence::FirstViolation{2.0, "the witness finds something"};
  const certify::MatchResult own = certify::match_events(run, {companion}, 2.0, names);
  CHECK(own.until == 2.0);
  CHECK(certain(own) == 1);
  CHECK(own.reason == "the witness finds something");
  run.first_violation.reset();
  companion.first_violation = certify::EventSequence::FirstViolation{0.5, "in the companion"};
  CHECK(certify::match_events(run, {companion}, 2.0, names).until == 0.5);
}
