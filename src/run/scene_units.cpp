#include "run/scene_units.hpp"

#include <array>
#include <initializer_list>
#include <string_view>
#include <utility>

namespace signorini::run {
namespace {

constexpr std::array<std::pair<std::string_view, Unit>, 5> units_by_name = {{{"time", unit::time},
                                                                             {"length", unit::length},
                                                                             {"force", unit::force},
                                                                             {"length/time", unit::velocity},
                                                                             {"force time", unit::impulse}}};

class ToScene {
 public:
  explicit ToScene(const Factors& factors) : factors_(factors) {}

  void operator()(const Unit& of, std::initializer_list<double*> values) const {
    const double factor = scene::factor_of(of, factors_);
    for (double* x : values) *x *= factor;
  }
  void operator()(const Unit& of, std::optional<double>& x) const {
    if (x) *x *= scene::factor_of(of, factors_);
  }
  void operator()(ContactSample& c) const {
    (*this)(unit::length, {&c.gap, &c.ut, &c.slip, &c.memory});
    (*this)(unit::velocity, {&c.vt});
    (*this)(unit::force, {&c.N, &c.T});
  }
  void operator()(Energy& e) const {
    (*this)(unit::energy,
            {&e.kinetic, &e.elastic, &e.contact, &e.damping, &e.friction, &e.impact, &e.loads, &e.surface});
  }
  void operator()(const Unit& of, Extreme& extreme) const {
    (*this)(of, {&extreme.value});
    (*this)(unit::time, {&extreme.t});
  }

  void operator()(Audit& a) const {
    (*this)(unit::length, a.gap);
    (*this)(unit::force, a.tension);
    (*this)(unit::energy, a.product);
    (*this)(unit::force, a.friction);
    (*this)(unit::power, a.direction);
    (*this)(unit::force, a.equilibrium);
    (*this)(unit::length, a.penetration);
    (*this)(unit::energy, a.energy);
    (*this)(unit::force, a.at_limit);
    if (a.reactions) (*this)(unit::force, *a.reactions);
    (*this)(unit::length, {&a.length_scale});
    (*this)(unit::force, {&a.force_scale});
    (*this)(unit::power, {&a.power_scale});
    (*this)(unit::energy, {&a.energy_scale, &a.work_of_loads});
    for (double& work : a.friction_work) (*this)(unit::energy, {&work});
    (*this)(a.initial);
    (*this)(a.final);
  }

 private:
  Factors factors_;
};

}  // namespace

// Converts every column by its unit in event_columns. guard_rate has no such unit and is not converted.
Event to_scene_units(Event event, const Factors& of) {
  const ToScene convert(of);
  for (const EventColumn& column : event_columns)
    for (const auto& [name, unit] : units_by_name) {
      if (name != column.unit) continue;
      if (const auto* number = std::get_if<double Event::*>(&column.field))
        convert(unit, {&(event.**number)});
      else if (const auto* optional = std::get_if<std::optional<double> Event::*>(&column.field))
        convert(unit, event.**optional);
    }
  return event;
}

Sample to_scene_units(Sample sample, const Factors& of) {
  const ToScene convert(of);
  convert(unit::time, {&sample.t});
  for (ContactSample& c : sample.contacts) convert(c);
  convert(sample.energy);
  return sample;
}

Report to_scene_units(Report report, const Factors& of) {
  const ToScene convert(of);
  convert(unit::time, {&report.outcome.t});
  if (report.first_undecided) convert(unit::time, {&*report.first_undecided});
  convert(report.audit);
  for (Violation& v : report.law_checks.violations) {
    convert(unit::time, {&v.t});
    convert(v.unit, {&v.value, &v.limit});
  }
  for (Peak& peak : report.peaks) {
    convert(unit::length, {&peak.tangential, &peak.normal});
    convert(unit::force, {&peak.N, &peak.T});
  }
  for (SupportLoad& load : report.supports) {
    for (TimedExtreme* turn : {&load.min_N, &load.max_N, &load.min_T, &load.max_T}) {
      convert(unit::force, {&turn->value});
      convert(unit::time, {&turn->t});
    }
    convert(unit::length, {&load.slip_at_start, &load.slip_at_end});
  }
  for (std::vector<Landing>& list : report.landings)
    for (Landing& landing : list) {
      convert(unit::time, {&landing.start, &landing.end});
      convert(unit::impulse, {&landing.impulse});
      convert(unit::force, {&landing.peak_force});
    }
  return report;
}

Report to_scene_units(Report report, const Model& computed) {
  report = to_scene_units(std::move(report), computed.unit);
  const ToScene convert(computed.unit);
  for (std::size_t i = 0; i < report.response.size(); ++i) {
    OutputExtremes& e = report.response[i];
    convert(computed.outputs[i].unit, {&e.maximum, &e.minimum, &e.last});
    convert(unit::time, {&e.t_maximum, &e.t_minimum});
  }
  return report;
}

Vector to_scene_units(Vector motion, const std::vector<Dof>& dofs, int order, const Factors& of) {
  const double per_time = scene::factor_of({0, 0, -order}, of);
  for (std::size_t i = 0; i < dofs.size(); ++i)
    motion[static_cast<Eigen::Index>(i)] *= dofs[i].rotation ? per_time : of.length * per_time;
  return motion;
}

InstantRow to_scene_units(InstantRow row, const std::vector<Dof>& dofs, const Factors& of) {
  const ToScene convert(of);
  convert(unit::time, {&row.t, &row.resolution});
  for (InstantSide* side : {&row.before, &row.after}) {
    side->u = to_scene_units(std::move(side->u), dofs, 0, of);
    side->v = to_scene_units(std::move(side->v), dofs, 1, of);
    if (side->a.size() > 0) side->a = to_scene_units(std::move(side->a), dofs, 2, of);
    for (ContactState& state : side->states) convert(unit::length, {&state.anchor});
    side->forces *= of.force;
  }
  for (InstantImpact& impact : row.impacts) convert(unit::impulse, {&impact.normal, &impact.tangent});
  row.capture_impulses *= scene::factor_of(unit::impulse, of);
  return row;
}

void SceneUnitsRecorder::motion(int contact, const std::vector<MotionRow>& rows) {
  const ToScene convert(model_.unit);
  std::vector<MotionRow> result = rows;
  for (MotionRow& row : result) {
    convert(unit::time, {&row.t});
    convert(row.sample);
  }
  recorder_.motion(contact, result);
}

void SceneUnitsRecorder::response(double t, const std::vector<double>& values) {
  values_ = values;
  for (std::size_t i = 0; i < values_.size(); ++i)
    values_[i] *= scene::factor_of(model_.outputs[i].unit, model_.unit);
  recorder_.response(t * model_.unit.time, values_);
}

RoundListener to_scene_units(const RoundListener& listener, const Model& model) {
  if (!listener) return {};
  return [listener, &model](const DecisionRound& round) {
    DecisionRound result = round;
    result.t *= model.unit.time;
    listener(result);
  };
}

Sample SceneUnitsRecorder::in_scene(const Sample& sample) {
  u_ = to_scene_units(*sample.u, model_.physical_dofs(), 0, model_.unit);
  v_ = to_scene_units(*sample.v, model_.physical_dofs(), 1, model_.unit);
  Sample result = to_scene_units(sample, model_.unit);
  result.u = &u_;
  result.v = &v_;
  return result;
}

}  // namespace signorini::run
