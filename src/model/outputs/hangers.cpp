#include "model/outputs/hangers.hpp"

#include <fmt/core.h>

#include <cmath>
#include <limits>

#include "model/outputs/structure_rows.hpp"

namespace signorini {
namespace {

constexpr double usual_variability = 0.25;  // limit of the piping codes MSS SP-58 and ASME B31.1

}  // namespace

void find_hangers(const Scene& scene, const DofMap& map, Model& model) {
  std::optional<StructureRows> rows;
  for (std::size_t i = 0; i < scene.springs.size(); ++i) {
    const Spring& spring = scene.springs[i];
    if (spring.preload == 0.0) continue;
    if (!rows) rows.emplace(scene, map, 0.0, 0.0);
    Spring elastic = spring;
    elastic.damping = 0.0;
    PhysicalRow row(map.size());
    rows->add_spring(row, elastic, false, 1.0);
    double force = row.constant + row.u.dot(model.u0);
    for (const Output::Given& given : row.given) force += given.history.value(0.0);
    model.hangers.push_back({i + 1, spring.preload, force, spring.hot_load});
  }
}

double variability(const HangerLoad& hanger) {
  return hanger.at_start == 0.0 ? std::numeric_limits<double>::infinity()
                                : std::abs(hanger.cold - hanger.at_start) / std::abs(hanger.at_start);
}

std::vector<std::string> hanger_doubts(const Scene& scene, const Model& model) {
  std::vector<std::string> doubts;
  for (const HangerLoad& h : model.hangers) {
    const Spring& spring = scene.springs[h.spring - 1];
    const double along = spring.direction[0] * scene.gravity[0] + spring.direction[1] * scene.gravity[1];
    // The force on the node is -cold direction.
    if (h.hot && h.cold * along < 0.0)
      doubts.push_back(
          fmt::format("the hanger of spring {} pushes its node along gravity; its direction goes from the "
                      "hanger's anchor to the node",
                      h.spring));
  }
  if (!model.static_start) return doubts;
  for (const HangerLoad& h : model.hangers) {
    const double cold = h.cold * model.unit.force, now = h.at_start * model.unit.force;
    const std::string& unit = model.units.force;
    if ((cold > 0.0) != (now > 0.0))
      doubts.push_back(
          fmt::format("spring {} carries {:.6g} {} in equilibrium and {:.6g} {} in the undeformed state: the "
                      "sign differs",
                      h.spring, now, unit, cold, unit));
    else if (variability(h) > usual_variability)
      doubts.push_back(
          fmt::format("spring {} carries {:.6g} {} in equilibrium and {:.6g} {} in the undeformed state: its "
                      "variability is {:.3g} %, usual is at most 25 %",
                      h.spring, now, unit, cold, unit, 100.0 * variability(h)));
  }
  return doubts;
}

}  // namespace signorini
