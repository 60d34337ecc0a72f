#include "differential/seen_run.hpp"

#include <chrono>
#include <cmath>

#include "differential/relation.hpp"

namespace signorini::differential {
namespace {

constexpr long steps_an_event = 10;  // as of Track

/// Keeps rows until steps or time are up.
class Kept : public Result {
 public:
  explicit Kept(const Bounds& bounds)
      : most_(bounds.steps),
        end_(std::chrono::steady_clock::now() +
             std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                 std::chrono::duration<double>(bounds.seconds))) {}
  bool progress(double /*t*/) override { return ++steps_ <= most_ && in_time(); }
  void event(const Event& event) override {
    steps_ += steps_an_event;
    Result::event(event);
  }
  [[nodiscard]] bool in_time() const { return std::chrono::steady_clock::now() < end_; }

 private:
  long most_, steps_ = 0;
  std::chrono::steady_clock::time_point end_;
};

std::vector<SeenColumn> columns_of(const Scene& scene, const Model& model) {
  using Of = SeenColumn::Of;
  std::vector<SeenColumn> columns;
  for (const Contact& c : model.contacts) {
    columns.push_back({c.name + ".N", Of::force, unit::force, c.name});
    columns.push_back({c.name + ".T", Of::force, unit::force, c.name});
    columns.push_back({c.name + ".gap", Of::gap, unit::length, c.name, false});
    columns.push_back({c.name + ".slip", Of::slip, unit::length, c.name, false});
  }
  for (const OutputSpec& output : scene.outputs) {
    const bool smooth = output.kind == OutputKind::displacement || output.kind == OutputKind::relative ||
                        output.quantity == OutputQuantity::gap || output.quantity == OutputQuantity::slip ||
                        output.quantity == OutputQuantity::loss;
    const bool sums = output.quantity == OutputQuantity::loss;
    columns.push_back({output.name, Of::output, unit_of(scene, output), "", !smooth, sums});
  }
  columns.push_back({"stored energy", Of::stored, unit::energy, "", true});
  columns.push_back({"losses", Of::spent, unit::energy, "", true, true});
  columns.push_back({"works", Of::spent, unit::energy, "", true, true});
  return columns;
}

/// Rows of response at the times of samples: of two at one instant the later one.
std::vector<double> response_at(const Kept& run, double t, std::size_t& next, std::size_t width) {
  while (next < run.responses.size() && run.responses[next].t <= t) ++next;
  if (next > 0 && run.responses[next - 1].t == t) return run.responses[next - 1].values;
  return std::vector<double>(width, std::nan(""));
}

void take_rows(const Kept& run, std::size_t outputs, SeenRun& seen) {
  std::size_t next = 0;
  for (const Result::Row& row : run.rows) {
    SeenRun::Row figures{row.t, {}};
    for (const ContactSample& c : row.contacts)
      for (const double x : {c.N, c.T, c.gap, c.slip}) figures.values.push_back(x);
    for (const double x : response_at(run, row.t, next, outputs)) figures.values.push_back(x);
    const Energy& e = row.energy;
    figures.values.push_back(e.stored());
    figures.values.push_back(e.damping + e.friction + e.impact);
    figures.values.push_back(e.loads + e.surface);
    seen.rows.push_back(std::move(figures));
  }
}

void take_events(const Kept& run, const Model& model, const std::optional<Certificate>& certificate,
                 SeenRun& seen) {
  for (std::size_t i = 0; i < run.events.size(); ++i) {
    const Event& event = run.events[i];
    if (event.contact < 0) {
      seen.instants.push_back(event.t);
      continue;
    }
    compare::LoggedEvent row{event.t,
                             model.contacts[static_cast<std::size_t>(event.contact)].name,
                             to_string(event.type),
                             to_string(event.from),
                             to_string(event.to),
                             0.0};
    if (certificate) row.uncertainty = certificate->t_errors[i];
    seen.events.push_back(std::move(row));
  }
}

SeenRun see(const Scene& scene, const Bounds& bounds, Certify certify, run::FaultInjector* faults = nullptr) {
  SeenRun seen;
  RunSpec spec = scene.run;
  spec.certify = certify;
  Kept run(bounds);
  CertifiedReport found;
  Model model;
  try {
    model = build_model(scene);
    CertifyOptions options;
    options.go_on = [&run] { return run.in_time(); };
    if (faults != nullptr)
      found.report = run::simulate(model, spec, run, *faults);
    else
      found = simulate_certified(model, spec, run, options);
  } catch (const SceneError& error) {
    seen.end = Track::End::refused;
    seen.said = error.what();
    seen.reason = reason_class(
        seen.said.substr(seen.said.find(": ") == std::string::npos ? 0 : seen.said.rfind(": ") + 2));
    return seen;
  }
  seen.open_start = !model.statics.undetermined.empty();
  const Outcome& outcome = found.report.outcome;
  seen.t = outcome.t;
  seen.said = outcome.reason;
  seen.reason = reason_class(outcome.reason);
  for (const std::string& warning : found.report.warnings)
    seen.shared = seen.shared || warning.find("hold the same motion") != std::string::npos;
  if (outcome.kind == Outcome::Kind::stopped) seen.end = Track::End::stopped;
  if (outcome.kind == Outcome::Kind::interrupted) seen.end = Track::End::too_long;
  seen.until = seen.t;
  if (found.certificate && !found.certificate->complete) seen.until = found.certificate->until;
  for (const Contact& c : model.contacts) seen.contacts.push_back(c.name);
  for (const OutputSpec& output : scene.outputs) seen.outputs.push_back(output.name);
  seen.columns = columns_of(scene, model);
  take_events(run, model, found.certificate, seen);
  take_rows(run, scene.outputs.size(), seen);
  seen.extremes = found.report.response;
  seen.peaks = found.report.peaks;
  if (found.certificate) seen.peak_bounds = found.certificate->peaks;
  return seen;
}

}  // namespace

SeenRun see(const Scene& scene, const Bounds& bounds) { return see(scene, bounds, Certify::yes); }
SeenRun see_plainly(const Scene& scene, const Bounds& bounds) { return see(scene, bounds, Certify::no); }
SeenRun see_injected(const Scene& scene, const Bounds& bounds, run::FaultInjector& faults) {
  return see(scene, bounds, Certify::no, &faults);
}

}  // namespace signorini::differential
