#include "cli/run_text.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "base/text.hpp"
#include "engine/tolerance.hpp"
#include "model/statics/static_system.hpp"
#include "run/cost_estimate.hpp"
#include "run/engines.hpp"

namespace signorini::cli {
namespace {

std::string name_of(const Model& model, int contact) {
  return contact < 0 ? "" : model.contacts[static_cast<std::size_t>(contact)].name;
}

std::string times(long count, const char* one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

// Force as text; a force that is only rounding, such as N of a contact that opens, is shown as 0.
std::string force(const Model& model, double value) {
  return number(std::abs(value) < 1e-10 * model.scales.force ? 0.0 : value);
}

/// Table of events. With a certificate it has a column of error bounds, and a line after the last certified event.
class EventTable {
 public:
  EventTable(const Model& model, const Certificate* certificate)
      : model_(model),
        certificate_(certificate),
        table_(certificate != nullptr ? with_error(header(model)) : header(model),
               certificate != nullptr ? std::vector{true, true, false, false, false, true, true}
                                      : std::vector{true, false, false, false, true, true}) {}

  /// Adds an event. row: index of the event among all events, from 0.
  void add(const Event& e, std::size_t row) {
    const bool certain = certificate_ == nullptr || certificate_->certain(row);
    if (!certain && !printed_) table_.line("  --- not certified from here on: " + certificate_->reason);
    printed_ = printed_ || !certain;
    std::vector<std::string> cells = {fmt::format("{:.9g}", e.t), name_of(model_, e.contact),
                                      to_string(e.type)};
    if (e.contact < 0) {
      cells.insert(cells.end(), {"", "", ""});
    } else {
      const std::string hit = e.impulse_n ? fmt::format(", impulse {}", number(*e.impulse_n)) : "";
      cells.insert(cells.end(), {fmt::format("{} -> {}", to_string(e.from), to_string(e.to)) + hit,
                                 force(model_, e.N), force(model_, e.T)});
    }
    if (certificate_ != nullptr)
      cells.insert(cells.begin() + 1, certain ? fmt::format("{:.1e}", certificate_->t_errors[row]) : "?");
    table_.row(std::move(cells));
  }
  void line(std::string text) { table_.line(std::move(text)); }
  [[nodiscard]] std::string str(TableStyle style) const { return table_.str(style); }

 private:
  static std::vector<std::string> header(const Model& model) {
    const std::string unit = " [" + model.units.force + "]";
    return {"t [" + model.units.time + "]", "contact", "event", "from -> to", "N" + unit, "T" + unit};
  }
  static std::vector<std::string> with_error(std::vector<std::string> names) {
    names.insert(names.begin() + 1, "error bound");
    return names;
  }

  const Model& model_;
  const Certificate* certificate_;
  Table table_;
  bool printed_ = false;
};

std::string events_by_type(const Report& report) {
  std::string text;
  for (const auto& [type, name, meaning] : all_event_types) {
    const auto found = report.events_by_type.find(name);
    if (found == report.events_by_type.end() || found->second == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", found->second, name);
  }
  return text.empty() ? "none" : text;
}

void add_extreme(Table& table, const Model& model, const char* what, const Extreme& extreme, double scale,
                 const std::string& unit) {
  const double relative = scale > 0.0 ? extreme.value / scale : 0.0;
  const std::string contact = name_of(model, extreme.contact);
  const std::string where = fmt::format("t = {:.6g}{}", extreme.t, contact.empty() ? "" : ", " + contact);
  table.row({what, fmt::format("{:.2g}", relative), fmt::format("{:.2g} {}", extreme.value, unit),
             extreme.value == 0.0 ? "" : where});
}

/// Row for contacts that rest at their friction limit; none if there are no such contacts.
void add_contacts_at_limit(Table& table, const Model& model, const Audit& a) {
  if (a.contacts_at_limit == 0) return;
  const Extreme& off = a.at_limit;
  table.row({fmt::format("at rest at |T| = T_U: {}", base::count_text(a.contacts_at_limit, "contact")),
             fmt::format("{:.2g}", a.force_scale > 0.0 ? off.value / a.force_scale : 0.0),
             fmt::format("{:.2g} {}", off.value, model.units.force),
             fmt::format("t = {:.6g}, {}", off.t, name_of(model, off.contact))});
}

std::string method_of(const Method& method) {
  const EngineInfo& engine = engine_info(method.engine);
  const std::string name = fmt::format("{}{}", method.automatic ? "auto: " : "", engine.name);
  switch (engine.accuracy) {
    case Accuracy::rounding:
      return fmt::format("{} ({})", name, method.flow == "modal" ? "closed form in modes" : engine.title);
    case Accuracy::step:
      return fmt::format("{}, dt {:g}", name, method.accuracy);
    case Accuracy::tolerance:
      return fmt::format("{}, rtol {:g}, order at most {}", name, method.accuracy, method.max_order);
  }
  return name;
}

/// Time of an extreme, "0.31"; for an envelope with its place, "0.31, A-B 0.625 left".
std::string when_and_where(const Output& output, double t, const OutputPlace& place) {
  if (place.segment < 0) return number(t);
  const Output::Segment& stretch = output.segments[static_cast<std::size_t>(place.segment)];
  return fmt::format("{}, {}-{} {}{}", number(t), stretch.from, stretch.to, number(place.station),
                     stretch.fibre == Fibre::left    ? " left"
                     : stretch.fibre == Fibre::right ? " right"
                                                     : "");
}

}  // namespace

std::string start_table(const Model& model, TableStyle style) {
  const std::size_t most = style == TableStyle::plain ? 24 : model.statics.events.size();
  if (!model.statics.frictional) return "";
  std::string stages;
  for (const StageEnd& end : model.statics.stages)
    if (end.fraction == 1.0) stages += fmt::format("{}{}", stages.empty() ? "" : ", ", end.stage);
  const std::string title = fmt::format("frictional start, stages: {}", stages);
  if (model.statics.events.empty())
    return style == TableStyle::plain ? title + "; no contact changed its state\n" : "";
  Table table({"stage", "part", "contact", "from -> to"}, {false, true, false, false});
  for (std::size_t i = 0; i < model.statics.events.size() && i < most; ++i) {
    const StageEvent& e = model.statics.events[i];
    table.row({e.stage, fmt::format("{:.6g}", e.fraction), name_of(model, e.contact),
               fmt::format("{} -> {}", to_string(e.from), to_string(e.to))});
  }
  if (model.statics.events.size() > most)
    table.line(fmt::format("... {} more; all are in summary.json", model.statics.events.size() - most));
  return style == TableStyle::plain ? title + "\n" + table.str() : table.str(style);
}

std::string event_table(const ProgressDisplay& display, const Model& model, const Certificate* certificate,
                        TableStyle style) {
  EventTable table(model, certificate);
  const auto& first = display.first_events();
  const bool all = display.event_count() == static_cast<long>(first.size());
  const std::size_t shown = all ? first.size() : ProgressDisplay::shown_first;
  for (std::size_t i = 0; i < shown; ++i) table.add(first[i], i);
  if (!all) {
    const long left_out =
        display.event_count() - static_cast<long>(ProgressDisplay::shown_first + ProgressDisplay::shown_last);
    table.line(fmt::format("... {} more; all {} are in events.csv", left_out, display.event_count()));
    std::size_t row = static_cast<std::size_t>(display.event_count()) - display.last_events().size();
    for (const Event& e : display.last_events()) table.add(e, row++);
  }
  if (first.empty()) return style == TableStyle::plain ? "  no events\n" : "";
  return table.str(style);
}

std::string support_table(const Model& model, const Report& report, TableStyle style) {
  const std::size_t most = style == TableStyle::plain ? 24 : model.contacts.size();
  if (model.contacts.empty() || report.supports.size() < model.contacts.size()) return "";
  const std::string force = " [" + model.units.force + "]", length = " [" + model.units.length + "]";
  const std::string at = "at t [" + model.units.time + "]";
  double farthest = 0.0, greatest = 0.0;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    farthest = std::max(farthest, report.peaks[k].tangential);
    greatest = std::max({greatest, report.peaks[k].N, report.peaks[k].T});
  }
  // A number that is only rounding, relative to the largest number of its kind, is shown as 0.
  const auto beside = [](double x, double most_of_all) {
    return number(std::abs(x) > rounding::many_operations * most_of_all ? x : 0.0);
  };
  Table table({"support loads", "N at rest" + force, "N min" + force, at, "N max" + force, at,
               "T min" + force, at, "T max" + force, at, "residual slip" + length,
               "friction loss [" + model.units.force + " " + model.units.length + "]"},
              {false, true, true, true, true, true, true, true, true, true, true, true});
  for (std::size_t k = 0; k < model.contacts.size() && k < most; ++k) {
    const SupportLoad& load = report.supports[k];
    const auto reaction = statics::static_reaction(model, k);
    std::vector<std::string> cells{model.contacts[k].name,
                                   reaction ? beside(*reaction == 0.0 ? 0.0 : -*reaction, greatest) : ""};
    for (const TimedExtreme& turn : {load.min_N, load.max_N, load.min_T, load.max_T}) {
      cells.push_back(beside(turn.value, greatest));
      cells.push_back(number(turn.t));
    }
    const auto& work = report.audit.friction_work;
    cells.push_back(beside(load.residual_slip(), farthest));
    cells.push_back(k < work.size() ? number(work[k]) : "");
    table.row(std::move(cells));
  }
  if (model.contacts.size() > most)
    table.line(fmt::format("... {} more; all are in summary.json", model.contacts.size() - most));
  return table.str(style);
}

std::string contact_table(const Model& model, const Report& report, TableStyle style) {
  const std::size_t most = style == TableStyle::plain ? 24 : model.contacts.size();
  if (model.contacts.empty() || report.peaks.size() < model.contacts.size()) return "";
  const std::string unit = " [" + model.units.length + "]";
  double greatest = 0.0;
  for (const Peak& peak : report.peaks) greatest = std::max({greatest, peak.tangential, peak.normal});
  // A displacement that is only rounding, relative to the largest displacement, is shown as 0.
  const auto length = [&](double x) { return number(x > rounding::many_operations * greatest ? x : 0.0); };
  Table table({"greatest displacement relative to the start", "along t" + unit, "along n" + unit},
              {false, true, true});
  for (std::size_t k = 0; k < model.contacts.size() && k < most; ++k)
    table.row({model.contacts[k].name, length(report.peaks[k].tangential), length(report.peaks[k].normal)});
  if (model.contacts.size() > most)
    table.line(fmt::format("... {} more; all are in summary.json", model.contacts.size() - most));
  return table.str(style);
}

std::string response_table(const Model& model, const Report& report, TableStyle style) {
  const std::size_t most = style == TableStyle::plain ? 40 : model.outputs.size();
  if (report.response.size() != model.outputs.size() || model.outputs.empty()) return "";
  const std::string at = "at t [" + model.units.time + "]";
  Table table({"response", "unit", "maximum", at, "minimum", at, "at the end"},
              {false, false, true, true, true, true, true});
  for (std::size_t i = 0; i < model.outputs.size() && i < most; ++i) {
    const OutputExtremes& e = report.response[i];
    const Output& output = model.outputs[i];
    table.row({output.name, unit_text(output.unit, model.units), number(e.maximum),
               when_and_where(output, e.t_maximum, e.at_maximum), number(e.minimum),
               when_and_where(output, e.t_minimum, e.at_minimum), number(e.last)});
  }
  if (model.outputs.size() > most)
    table.line(fmt::format("... {} more; all are in summary.json", model.outputs.size() - most));
  return table.str(style);
}

std::string audit_table(const Model& model, const Audit& a, TableStyle style) {
  const std::string& force = model.units.force;
  const std::string& length = model.units.length;
  const std::string energy = force + " " + length;
  Table table({"audit: greatest violation", "relative", "value", "where"}, {false, true, true, false});
  add_extreme(table, model, "gap g < 0", a.gap, a.length_scale, length);
  add_extreme(table, model, "tension N > 0", a.tension, a.force_scale, force);
  add_extreme(table, model, "complementarity |g N|", a.product, a.energy_reference(), energy);
  if (std::any_of(model.contacts.begin(), model.contacts.end(),
                  [](const Contact& c) { return c.takes_impulses(); }))
    add_extreme(table, model, "penetration", a.penetration, a.length_scale, length);
  add_extreme(table, model, "friction |T| > T_U", a.friction, a.force_scale, force);
  add_extreme(table, model, "friction against slip T p' < 0", a.direction, a.power_scale,
              energy + "/" + model.units.time);
  add_extreme(table, model, "equilibrium", a.equilibrium, a.force_scale, force);
  if (a.reactions) add_extreme(table, model, "sum of reactions", *a.reactions, a.force_scale, force);
  add_extreme(table, model, "energy balance", a.energy, a.energy_reference(), energy);
  add_contacts_at_limit(table, model, a);
  return table.str(style);
}

std::string run_summary(const RunSpec& run, const Model& model, const Report& report) {
  const Audit& a = report.audit;
  const Counters& c = report.counters;
  std::string text = audit_table(model, a);
  text += fmt::format(
      "\nenergy: greatest work of the loads {} {} {}; lost by friction {}, damping {}, impacts {}\n",
      number(a.work_of_loads), model.units.force, model.units.length, number(a.final.friction),
      number(a.final.damping), number(a.final.impact));
  text += "events: " + events_by_type(report) + "\n";
  if (a.impulses_on_closed > 0)
    text += fmt::format("impacts that also acted on closed contacts: {}\n", a.impulses_on_closed);
  if (std::any_of(model.contacts.begin(), model.contacts.end(), [](const Contact& contact) {
        return contact.takes_impulses() && !contact.capture_velocity;
      }))
    text += fmt::format("contacts that rebound slower than {} {}/{} stay closed (capture_velocity)\n",
                        number(engine::tolerance_of(model, run).capture_velocity()), model.units.length,
                        model.units.time);
  text += fmt::format("effort: {}, {}, {}, {:.2f} s\n", method_of(report.method), times(c.steps, "step"),
                      times(c.restarts, "restart"), report.wall_time);
  const Engine closed_form = run::engine_for(run::EngineRole::closed_form);
  if (report.method.automatic && report.method.engine != closed_form)
    return text +
           fmt::format("reason for engine {}: {}\n", to_string(report.method.engine), report.method.reason);
  RunSpec chosen = run;
  chosen.engine = report.method.engine;
  // A line about engine exact is printed only if exact would be faster than the run. After a run longer than long_run, a trial
  // of exact replaces the estimate.
  std::optional<double> exact = run::seconds_with_exact(model, chosen);
  constexpr double long_run = 1.0, share = 0.02;  // s; duration of the trial / duration of the run
  if (exact && report.wall_time > long_run) {
    exact = run::seconds_by_trial(model, run, closed_form, share * report.wall_time);
    if (*exact == 0.0) exact.reset();
  }
  if (exact && *exact < report.wall_time)
    text += fmt::format("{0} would take {1} s (--engine {0})\n", to_string(closed_form),
                        run::seconds_text(*exact));
  return text;
}

std::string reduction_text(const Model& model, const CertifiedReport& run) {
  if (!model.reduction) return "";
  const Reduction& r = *model.reduction;
  std::string text = fmt::format("reduction: {} modes, up to {:.4g} rad/{}, {} left out", r.modes, r.cutoff,
                                 model.units.time, r.truncated_modes);
  if (!r.trials.empty())
    text += fmt::format(", error {:.2g} of the greatest displacement ({} trials)", r.trials.back().error,
                        r.trials.size());
  if (!run.reduction || model.contacts.empty() || r.truncated_modes == 0) return text + "\n";
  return text +
         fmt::format(
             "; they would change displacements at contacts by about {:.2g} {}\n  in one loading, and slips "
             "add up: a run with a higher cutoff shows what they change\n",
             run.reduction->displacement, model.units.length);
}

std::string certification_text(const Model& model, const CertifiedReport& run) {
  if (!run.certificate) return run.reason.empty() ? "" : "not certified: " + run.reason + "\n";
  const Certificate& c = *run.certificate;
  double greatest = 0.0;
  for (std::size_t i = 0; i < c.t_errors.size(); ++i)
    if (c.certain(i)) greatest = std::max(greatest, c.t_errors[i]);
  const std::string beside =
      fmt::format("companion: {}, {:.2f} s, waited {:.2f} s", c.companion, c.wall_time, c.wait);
  const bool reduced = model.reduction && model.reduction->truncated_modes > 0;
  const std::string what = reduced ? "reduced model certified" : "certified";
  const std::string to_end =
      run.report.outcome.kind == Outcome::Kind::done
          ? what + " to the end"
          : fmt::format("{} to t = {:.9g} {}, where the run ended", what, c.until, model.units.time);
  if (c.complete && c.t_errors.empty()) return fmt::format("{}: no event ({})\n", to_end, beside);
  // Without certified events there are no error bounds of times.
  const std::string times =
      c.certain_events() == 0 ? "" : fmt::format(", times within {:.1e} {}", greatest, model.units.time);
  std::string text =
      c.complete
          ? fmt::format("{}: all {} events{} ({})\n", to_end, c.t_errors.size(), times, beside)
          : fmt::format("{} until t = {:.9g} {}: {} of {} events{} ({}); reason: {}\n", what, c.until,
                        model.units.time, c.certain_events(), c.t_errors.size(), times, beside, c.reason);
  if (c.unordered > 0)
    text += fmt::format("the order of {} of neighbouring events of different contacts is not certified\n",
                        base::count_text(c.unordered, "pair"));
  return text;
}

}  // namespace signorini::cli
