#include "differential/track.hpp"

#include <cctype>
#include <chrono>

namespace signorini::differential {
namespace {

constexpr long steps_an_event = 10;  // about what a restart costs

/// Keeps a run's rows until its steps or its time are up.
class Bounded : public Result {
 public:
  explicit Bounded(const Bounds& bounds)
      : most_(bounds.steps),
        end_(std::chrono::steady_clock::now() +
             std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                 std::chrono::duration<double>(bounds.seconds))) {}
  bool progress(double /*t*/) override {
    return ++steps_ <= most_ && std::chrono::steady_clock::now() < end_;
  }
  void event(const Event& event) override {
    steps_ += steps_an_event;
    Result::event(event);
  }
  [[nodiscard]] long steps() const { return steps_; }

 private:
  long most_, steps_ = 0;
  std::chrono::steady_clock::time_point end_;
};

compare::LoggedEvent logged(const Event& event, const Model& model) {
  compare::LoggedEvent row;
  row.t = event.t;
  row.type = to_string(event.type);
  row.from = to_string(event.from);
  row.to = to_string(event.to);
  row.uncertainty = event.t_uncertainty.value_or(0.0);
  if (event.contact >= 0) row.contact = model.contacts[static_cast<std::size_t>(event.contact)].name;
  return row;
}

}  // namespace

std::string reason_class(const std::string& sentence) {
  std::string kept;
  bool quoted = false;
  for (const char c : sentence) {
    if (c == '\'') quoted = !quoted;
    if (quoted || c == '\'' || std::isdigit(static_cast<unsigned char>(c)) != 0) continue;
    if (c == '(' || c == ':' || c == ';') break;
    kept += c;
  }
  while (!kept.empty() && kept.back() == ' ') kept.pop_back();
  return kept;
}

Track run(const Model& model, const RunSpec& spec, const Bounds& bounds) {
  Track track;
  Bounded rows(bounds);
  try {
    track.report = simulate(model, spec, rows);
  } catch (const SceneError& error) {
    track.end = Track::End::refused;
    track.said = error.what();
    track.reason = "refused";
    return track;
  }
  const Outcome& outcome = track.report.outcome;
  track.t = outcome.t;
  track.steps = rows.steps();
  track.said = outcome.reason;
  track.reason = reason_class(outcome.reason);
  for (const Event& event : rows.events) track.events.push_back(logged(event, model));
  track.rows = std::move(rows.rows);
  if (outcome.kind == Outcome::Kind::interrupted) track.end = Track::End::too_long;
  if (outcome.kind == Outcome::Kind::stopped) {
    track.end = Track::End::stopped;
    track.events.push_back({outcome.t, "(run)", track.reason, "", "", 0.0});
  }
  return track;
}

}  // namespace signorini::differential
