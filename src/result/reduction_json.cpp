#include "result/reduction_json.hpp"

#include "base/json.hpp"

namespace signorini {

Json reduction_json(const Reduction& r, const Report* report) {
  Json json = {{"cutoff_omega", r.cutoff},
               {"modes_kept", r.modes},
               {"free_motions", r.free_modes},
               {"modes_left_out", r.left_out},
               {"highest_kept", r.highest_kept},
               {"first_left_out", r.first_left_out},
               {"static_shapes", r.massless_shapes},
               {"static_shapes_with_mass", r.massive_shapes},
               {"highest_with_mass", r.highest_massive},
               {"physical_degrees_of_freedom", r.dofs.size()},
               {"ringing_left_out", r.ringing},
               {"initial_displacement_lost", r.initial_displacement_lost},
               {"initial_velocity_lost", r.initial_velocity_lost}};
  if (r.tolerance) {
    json["tolerance"] = *r.tolerance;
    json["missed"] = r.tried.empty() ? Json() : Json(r.tried.back().missed);
    json["error"] = r.tried.empty() ? Json() : Json(r.tried.back().error);
    json["tried"] = Json::array();
    for (const CutoffTrial& trial : r.tried)
      json["tried"].push_back({{"cutoff_omega", trial.cutoff_omega},
                               {"modes_kept", trial.modes},
                               {"missed", trial.missed},
                               {"moved", trial.moved},
                               {"error", trial.error}});
  }
  json["compliance"] = Json::array();
  for (const ComplianceShare& share : r.shares) {
    Json row = {{"of", share.what}, {"all_modes", share.compliance}, {"left_out", share.residual}};
    if (report != nullptr && share.contact >= 0 &&
        static_cast<std::size_t>(share.contact) < report->peaks.size()) {
      const Peak& peak = report->peaks[static_cast<std::size_t>(share.contact)];
      row["followed"] = share.residual * (share.normal ? peak.N : peak.T);
    }
    json["compliance"].push_back(std::move(row));
  }
  return json;
}

}  // namespace signorini
