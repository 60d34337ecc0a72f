#include "study/verify/observed.hpp"

namespace signorini {

std::vector<ObservedColumn> observed_columns(const Model& model) {
  const Units& units = model.units;
  std::vector<ObservedColumn> list;
  for (const Column& column : model.columns) {
    const char* kind = model.turns(column) ? column.velocity ? "angular_velocity" : "rotation"
                       : column.velocity   ? "velocity"
                                           : "displacement";
    list.push_back({column.name, kind, model.unit_of(column)});
  }
  for (const Contact& contact : model.contacts)
    for (const char* force : {".N", ".T"}) list.push_back({contact.name + force, "force", units.force});
  for (const Output& output : model.outputs) {
    const std::string unit = unit_text(output.unit, units);
    list.push_back({output.name, "output [" + unit + "]", unit});
  }
  return list;
}

Observed observed(Tracker&& tracker, Report report) {
  Observed result;
  result.track = {std::move(tracker.events), report.outcome.t, report.outcome.reason};
  result.rows = std::move(tracker.rows);
  result.report = std::move(report);
  return result;
}

Observed observe(const Model& model, const RunSpec& run, const std::function<bool()>& go_on) {
  Patient patient(go_on);
  Tracker tracker(model, true, &patient);
  Report report = simulate(model, run, tracker);
  return observed(std::move(tracker), std::move(report));
}

}  // namespace signorini
