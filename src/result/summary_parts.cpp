#include "result/summary_parts.hpp"

#include <array>
#include <cctype>
#include <utility>

#include "base/json.hpp"

namespace signorini::result {

base::Json reduction_json(const Reduction& r, const CertifiedReport* run) {
  const Report* report = run != nullptr ? &run->report : nullptr;
  base::Json json = {{"cutoff_omega", r.cutoff},
                     {"modes_kept", r.modes},
                     {"free_motions", r.free_modes},
                     {"modes_left_out", r.truncated_modes},
                     {"highest_kept", r.highest_kept},
                     {"first_left_out", r.first_truncated},
                     {"static_shapes", r.massless_shapes},
                     {"static_shapes_with_mass", r.massive_shapes},
                     {"highest_with_mass", r.highest_massive},
                     {"physical_degrees_of_freedom", r.dofs.size()},
                     {"ringing_left_out", r.ringing},
                     {"initial_displacement_lost", r.initial_displacement_lost},
                     {"initial_velocity_lost", r.initial_velocity_lost}};
  if (r.tolerance) {
    json["tolerance"] = *r.tolerance;
    json["missed"] = r.trials.empty() ? base::Json() : base::Json(r.trials.back().missed);
    json["error"] = r.trials.empty() ? base::Json() : base::Json(r.trials.back().error);
    json["tried"] = base::Json::array();
    for (const CutoffTrial& trial : r.trials)
      json["tried"].push_back({{"cutoff_omega", trial.cutoff_omega},
                               {"modes_kept", trial.modes},
                               {"missed", trial.missed},
                               {"moved", trial.moved},
                               {"error", trial.error}});
  }
  if (run != nullptr && run->reduction)
    json["left_out_at_contacts"] = {{"displacement", run->reduction->displacement},
                                    {"force", run->reduction->force}};
  json["compliance"] = base::Json::array();
  for (const ComplianceShare& share : r.shares) {
    base::Json row = {{"of", share.label}, {"all_modes", share.compliance}, {"left_out", share.residual}};
    if (report != nullptr && share.contact >= 0 &&
        static_cast<std::size_t>(share.contact) < report->peaks.size()) {
      const Peak& peak = report->peaks[static_cast<std::size_t>(share.contact)];
      row["followed"] = share.residual * (share.normal ? peak.N : peak.T);
    }
    json["compliance"].push_back(std::move(row));
  }
  return json;
}

base::Json units_json(const Units& units) {
  return {{"force", units.force}, {"mass", units.mass}, {"length", units.length}, {"time", units.time}};
}

Units units_from(const base::Json& json) {
  return {json.at("force"), json.at("mass"), json.at("length"), json.at("time")};
}

base::Json law_check_json(const Model& model, const LawCheckSummary& witness) {
  base::Json list = base::Json::array();
  for (const Violation& v : witness.violations)
    list.push_back(
        {{"t", v.t},
         {"event", v.event},
         {"contact", v.contact < 0 ? base::Json()
                                   : base::Json(model.contacts[static_cast<std::size_t>(v.contact)].name)},
         {"law", v.law},
         {"value", v.value},
         {"limit", v.limit}});
  return {{"checked", witness.checked}, {"violated", witness.violated}, {"violations", list}};
}

std::string unit_in_words(std::string_view unit, const Units& units) {
  const std::array<std::pair<std::string_view, const std::string*>, 4> words = {
      {{"force", &units.force}, {"mass", &units.mass}, {"length", &units.length}, {"time", &units.time}}};
  std::string text;
  for (std::size_t at = 0; at < unit.size();) {
    std::size_t end = at;
    while (end < unit.size() && std::isalpha(static_cast<unsigned char>(unit[end])) != 0) ++end;
    if (end == at) {
      text += unit[at] == '*' ? ' ' : unit[at];
      ++at;
      continue;
    }
    const std::string_view word = unit.substr(at, end - at);
    std::string name_shown(word);
    for (const auto& [name, own] : words)
      if (word == name) name_shown = *own;
    text += name_shown;
    at = end;
  }
  return text;
}

}  // namespace signorini::result
