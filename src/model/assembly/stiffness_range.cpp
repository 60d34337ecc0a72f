#include "model/assembly/stiffness_range.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace signorini {
namespace {

struct Stiffness {
  double value = 0.0;
  SourcePlace place;
  std::string key, what;
};

void add_members(const Scene& scene, const DofMap& map, std::vector<Stiffness>& all) {
  for (const MeshElement& e : map.mesh.elements) {
    const MeshNode &a = map.mesh.nodes[static_cast<std::size_t>(e.a)],
                   &b = map.mesh.nodes[static_cast<std::size_t>(e.b)];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const Section& section = scene.sections[static_cast<std::size_t>(e.section)];
    const Member& member = scene.members[static_cast<std::size_t>(e.member)];
    const std::string key = fmt::format("members.{}.section", e.member + 1);
    all.push_back({section.EA / length, member.place, key,
                   fmt::format("EA/L of an element of section '{}'", section.name)});
    if (e.type == MemberType::beam)
      all.push_back({section.EI / e.flexibility / length / length / length, member.place, key,
                     fmt::format("EI/L^3 of an element of section '{}'", section.name)});
  }
}

}  // namespace

void check_stiffness_range(const Scene& scene, const DofMap& map) {
  static const double widest = std::sqrt(std::numeric_limits<double>::max());
  std::vector<Stiffness> all;
  add_members(scene, map, all);
  for (std::size_t i = 0; i < scene.springs.size(); ++i)
    all.push_back({scene.springs[i].stiffness, scene.springs[i].place,
                   fmt::format("springs.{}.stiffness", i + 1), "the stiffness of this spring"});
  for (const ContactSpec& contact : scene.contacts)
    all.push_back({contact.normal_stiffness, contact.place, contact.key("normal_stiffness"),
                   fmt::format("normal_stiffness of contact '{}'", contact.name)});
  std::erase_if(all, [](const Stiffness& k) { return !(k.value > 0.0); });
  if (all.size() < 2) return;
  const auto less = [](const Stiffness& a, const Stiffness& b) { return a.value < b.value; };
  std::sort(all.begin(), all.end(), less);
  const Stiffness &low = all.front(), &high = all.back();
  if (low.value >= high.value / widest) return;
  const bool too_stiff = std::abs(std::log(high.value)) > std::abs(std::log(low.value));
  const Stiffness &odd = too_stiff ? high : low, &other = too_stiff ? low : high;
  throw SceneError(
      odd.place, odd.key,
      fmt::format("found {:.4g} as {}, beside {:.4g} as {}: with a ratio beyond {:.3g} squares of "
                  "frequencies leave the range of numbers; expected {}",
                  odd.value, odd.what, other.value, other.what, widest,
                  too_stiff ? "less, or a rigid body" : "more"));
}

}  // namespace signorini
