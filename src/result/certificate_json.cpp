#include "result/certificate_json.hpp"

#include <algorithm>

namespace signorini {
namespace {

/// What the modes that are left out may have moved contacts, and the forces that belong to it. An estimate: a
/// change of force may shift an event.
Json truncation_json(const Reduction& reduction, const Report& report) {
  double displacement = reduction.ringing, force = 0.0;
  for (const ComplianceShare& share : reduction.shares) {
    if (share.contact < 0 || static_cast<std::size_t>(share.contact) >= report.peaks.size()) continue;
    const Peak& peak = report.peaks[static_cast<std::size_t>(share.contact)];
    const double followed = share.residual * (share.normal ? peak.N : peak.T);
    displacement = std::max(displacement, reduction.ringing + followed);
    if (share.compliance > 0.0) force = std::max(force, (reduction.ringing + followed) / share.compliance);
  }
  return {{"displacement", displacement}, {"force", force}};
}

}  // namespace

Json certificate_json(const Model& model, const CertifiedReport& run) {
  if (!run.certificate) return nullptr;
  const Certificate& c = *run.certificate;
  Json json = {{"until", c.until},
               {"complete", c.complete},
               {"reason", c.reason},
               {"companion", c.companion},
               {"choice", c.choice},
               {"factor", c.factor},
               {"events", c.certain_events()},
               {"unordered", c.unordered}};
  json["first_uncertain"] = c.first_uncertain ? Json(*c.first_uncertain + 1) : Json(nullptr);
  json["wall_time"] = c.wall_time;
  json["wait"] = c.wait;
  if (model.reduction) json["reduction"] = truncation_json(*model.reduction, run.report);
  return json;
}

Json peak_errors_json(const CertifiedReport& run, std::size_t k) {
  if (!run.certificate || k >= run.certificate->peaks.size() || !run.certificate->peaks[k]) return nullptr;
  const Peak& e = *run.certificate->peaks[k];
  return {{"tangential", e.horizontal}, {"normal", e.vertical}, {"N", e.N}, {"T", e.T}};
}

Json landing_errors_json(const CertifiedReport& run, std::size_t k, std::size_t landing) {
  if (!run.certificate || k >= run.certificate->landings.size()) return nullptr;
  const auto& list = run.certificate->landings[k];
  if (landing >= list.size() || !list[landing]) return nullptr;
  const Landing& e = *list[landing];
  return {{"start", e.start},
          {"duration", e.start + e.end},
          {"peak_force", e.peak_force},
          {"impulse", e.impulse}};
}

}  // namespace signorini
