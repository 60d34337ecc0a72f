// summary_parts.hpp: parts of summary.json that other JSON outputs share: hangers, reduction, units, law
// check.
#pragma once

#include <string>
#include <string_view>

#include "base/json.hpp"
#include "model/outputs/reactions.hpp"
#include "signorini/certify.hpp"
#include "signorini/result.hpp"
#include "signorini/scene.hpp"

namespace signorini::result {

/// Springs with a preload, for summary.json and `signorini check --json`.
inline base::Json hangers_json(const Model& model) {
  base::Json list = base::Json::array();
  for (const HangerLoad& hanger : model.hangers) {
    base::Json json = {{"spring", hanger.spring}, {"cold", hanger.cold}, {"at_start", hanger.at_start}};
    if (hanger.hot) json["hot"] = *hanger.hot;
    if (hanger.at_start != 0.0) json["variability"] = outputs::variability(hanger);
    list.push_back(std::move(json));
  }
  return list;
}

/// A reduced model, for summary.json and `signorini check --json`. report: that of the run, or null. With a report every
/// direction of a contact has the key `followed`: compliance of the truncated modes times the largest contact force. This
/// is the displacement of the contact in the truncated modes, without their inertia.
[[nodiscard]] base::Json reduction_json(const Reduction& reduction, const CertifiedReport* run);

// The units of a scene as JSON, with the keys of scene files.

/// Object with force, mass, length, time.
[[nodiscard]] base::Json units_json(const Units& units);
/// The inverse of units_json. Errors: Json::exception.
[[nodiscard]] Units units_from(const base::Json& json);

// Results of a law checker, for summary.json and `signorini witness --json`.

/// {"checked", "violated", "violations": [{"t", "event", "contact", "law", "value", "limit"}, ...]}
[[nodiscard]] base::Json law_check_json(const Model& model, const LawCheckSummary& witness);

// Units of tables with the unit names of a scene.
//
//   "force/length", { force = "kN", length = "m" }   ->   "kN/m"        a product, "*", becomes a blank

/// Replaces the words force, mass, length and time in `unit` by the unit names; other words stay unchanged.
[[nodiscard]] std::string unit_in_words(std::string_view unit, const Units& units);

}  // namespace signorini::result
