// halves.hpp: a run, and the same run in two halves, the second of which goes on from the files of the first.
#pragma once

#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "own_folder.hpp"
#include "result/run_directory.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::halves {

struct Difference {
  bool events_agree = true;
  std::string first;  ///< event that differs
  double time = 0.0;  ///< of events, over t_end
  double state =
      0.0;  ///< of u, v, N, T, ut, slip at nine times after the split, over their greatest in the run
  std::size_t events = 0;
};

using Reader = std::function<Scene(const std::vector<Override>&)>;

inline constexpr int compared_rows = 9;

/// All that depends on time happens so much earlier.
inline void shift(Scene& scene, double t) {
  const auto earlier = [t](HistorySpec& history) { history.shift -= t; };
  for (LoadSpec& load : scene.loads) earlier(load.history);
  for (Member& member : scene.members) {
    earlier(member.temperature);
    earlier(member.initial_strain);
  }
  for (BodySpec& body : scene.bodies) earlier(body.temperature);
  for (Support& support : scene.supports)
    if (support.motion) earlier(*support.motion);
  for (ContactSpec& contact : scene.contacts) {
    earlier(contact.normal_force);
    earlier(contact.surface_velocity);
  }
  for (BaseMotionSpec& base : scene.base_motion) earlier(base.acceleration);
}

/// One run in memory and in a directory.
class Kept final : public Result {
 public:
  Kept(const std::filesystem::path& folder, const Scene& scene, const Model& model)
      : directory_(folder, scene, model, {true, {"test"}}) {}

  void event(const Event& event) override {
    Result::event(event);
    directory_.event(event);
  }
  void sample(const Sample& sample) override {
    Result::sample(sample);
    directory_.sample(sample);
  }
  void response(double t, const std::vector<double>& values) override {
    Result::response(t, values);
    directory_.response(t, values);
  }
  void frame(const Sample& sample) override { directory_.frame(sample); }
  void finish() { static_cast<void>(directory_.finish(report)); }

 private:
  result::RunDirectory directory_;
};

struct Sizes {
  double u = 0.0, v = 0.0, force = 0.0;
};

inline Sizes sizes_of(const Result& result) {
  Sizes s;
  for (const Result::Row& row : result.rows) {
    s.u = std::max(s.u, row.u.cwiseAbs().maxCoeff());
    s.v = std::max(s.v, row.v.cwiseAbs().maxCoeff());
    for (const ContactSample& c : row.contacts) s.force = std::max({s.force, std::abs(c.N), std::abs(c.T)});
  }
  return s;
}

inline double over(double difference, double size) {
  return size > 0.0 ? std::abs(difference) / size : std::abs(difference);
}

inline double apart(const Result::Row& a, const Result::Row& b, const Sizes& size) {
  double most = std::max(over((a.u - b.u).cwiseAbs().maxCoeff(), size.u),
                         over((a.v - b.v).cwiseAbs().maxCoeff(), size.v));
  for (std::size_t k = 0; k < a.contacts.size(); ++k) {
    const ContactSample &x = a.contacts[k], &y = b.contacts[k];
    most = std::max({most, over(x.N - y.N, size.force), over(x.T - y.T, size.force),
                     over(x.ut - y.ut, size.u), over(x.slip - y.slip, size.u)});
  }
  return most;
}

inline std::string show(const Event& e) {
  return fmt::format("t = {:.15g} contact {} {} -> {}", e.t, e.contact, to_string(e.from), to_string(e.to));
}

/// Each contact has the same events, in the same order. Of two contacts the order may be the other where their times differ by
/// less than what the run itself gives for their uncertainty, or by less than twice what times of the two runs differ, which
/// is limited: halves of a symmetric structure.
inline void compare_events(const std::vector<Event>& expected, const std::vector<Event>& found, double t,
                           double t_end, Difference& d) {
  d.events = expected.size();
  std::map<int, std::vector<std::size_t>> of_contact;
  for (std::size_t i = 0; i < expected.size(); ++i) of_contact[expected[i].contact].push_back(i);
  std::map<int, std::size_t> next;
  const auto differ = [&](const std::string& a, const std::string& b) {
    d.events_agree = false;
    d.first = fmt::format("{}, found {}; {} and {} events", a, b, expected.size(), found.size());
  };
  double latest = 0.0, slack = 0.0;
  for (const Event& event : found) {
    const std::vector<std::size_t>& own = of_contact[event.contact];
    std::size_t& place = next[event.contact];
    if (place == own.size()) return differ("none", show(event));
    const Event& partner = expected[own[place++]];
    d.time = std::max(d.time, std::abs(event.t + t - partner.t) / t_end);
    if (partner.to != event.to) return differ(show(partner), show(event));
    const double unsure =
        partner.t_uncertainty.value_or(0.0) + event.t_uncertainty.value_or(0.0) + 2.0 * d.time * t_end;
    if (partner.t < latest - slack - unsure) return differ("earlier: " + show(partner), show(event));
    if (partner.t >= latest) slack = unsure;
    latest = std::max(latest, partner.t);
  }
  if (found.size() < expected.size())
    for (const auto& [contact, own] : of_contact)
      if (next[contact] < own.size()) return differ(show(expected[own[next[contact]]]), "none");
}

inline Difference split_scene(const Reader& read, const std::vector<Override>& settings, double part) {
  const OwnFolder own;
  const auto folder = own.path() / "first";
  Scene whole = read(settings);
  const double t_end = whole.run.t_end;
  // Of steps of a given length a multiple.
  const double t = whole.run.dt ? std::round(part * t_end / *whole.run.dt) * *whole.run.dt : part * t_end;
  whole.run.output_dt.reset();
  whole.run.frames = {t};
  std::vector<double> times, later;
  for (int i = 1; i <= compared_rows; ++i) later.push_back((t_end - t) * i / compared_rows);
  for (const double s : later) times.push_back(s == later.back() ? t_end : t + s);
  times.insert(times.begin(), t);
  whole.run.output_times = times;

  const Model model = build_model(whole);
  Kept all(folder, whole, model);
  all.report = simulate(model, whole.run, all);
  all.finish();
  std::vector<Override> on = settings;
  on.push_back({"run.initial", fmt::format("{{ run = \"{}\", t = {} }}", folder.string(), t)});
  Scene second = read(on);
  REQUIRE(second.initial.saved);
  CHECK(second.initial.saved->structure_differences.empty());
  shift(second, t);
  second.run.t_end = t_end - t;
  second.run.output_dt.reset();
  second.run.frames.clear();
  second.run.output_times = later;
  const Result rest = simulate(build_model(second), second.run);

  Difference d;
  const double same_instant = 1e-9 * t_end;
  std::vector<Event> expected, found;
  for (const Event& e : all.events)
    if (e.t > t + same_instant) expected.push_back(e);
  for (const Event& e : rest.events)
    if (e.t > same_instant) found.push_back(e);
  compare_events(expected, found, t, t_end, d);
  const Sizes size = sizes_of(all);
  CHECK(rest.report.outcome.kind == all.report.outcome.kind);
  const std::size_t first = all.rows.size() - compared_rows;
  for (std::size_t i = 0; i < compared_rows && all.rows.size() == rest.rows.size() + 1; ++i)
    d.state = std::max(d.state, apart(all.rows[first + i], rest.rows[i], size));
  return d;
}

/// A run that goes on has no stages of a start.
inline std::string without_stages(std::string text) {
  const std::string stage = "[[run.stages]]";
  for (std::size_t at = text.find(stage); at != std::string::npos; at = text.find(stage))
    text.erase(at, text.find("\n[", at) + 1 - at);
  return text;
}

inline Difference split_text(const std::string& text, const std::vector<Override>& settings, double part,
                             const std::string& file = "test.toml") {
  return split_scene(
      [&](const std::vector<Override>& changes) {
        return parse_scene(changes.size() > settings.size() ? without_stages(text) : text, file, changes);
      },
      settings, part);
}

/// The scene of a file, split at this part of its t_end.
inline Difference split(const std::string& file, const std::vector<Override>& settings, double part) {
  std::ifstream in(file);
  return split_text({std::istreambuf_iterator<char>(in), {}}, settings, part, file);
}

}  // namespace signorini::tests::halves
