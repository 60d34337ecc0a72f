#include "result/certificate_json.hpp"

namespace signorini {

Json certificate_json(const CertifiedReport& run) {
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
  if (c.reduction)
    json["reduction"] = {{"displacement", c.reduction->displacement}, {"force", c.reduction->force}};
  return json;
}

Json peak_errors_json(const CertifiedReport& run, std::size_t k) {
  if (!run.certificate || k >= run.certificate->peaks.size() || !run.certificate->peaks[k]) return nullptr;
  const Peak& e = *run.certificate->peaks[k];
  return {{"tangential", e.tangential}, {"normal", e.normal}, {"N", e.N}, {"T", e.T}};
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
