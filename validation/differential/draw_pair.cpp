#include <algorithm>
#include <array>

#include "differential/features.hpp"

namespace signorini::differential {

bool are_alternatives(const Feature& a, const Feature& b) {
  return a.group[0] != '\0' && std::string(a.group) == b.group;
}

PairScene draw_pair(const std::vector<Feature>& features, const Feature& a, const Feature& b,
                    std::uint64_t seed, int beside) {
  PairScene result;
  constexpr std::array kits = {Kit::chain, Kit::block, Kit::frame, Kit::mesh, Kit::matrices};
  for (std::size_t i = 0; i < kits.size(); ++i) {
    const Kit drawn = kits[(seed + i) % kits.size()];
    const std::optional<Kit> forced = a.kit ? a.kit : b.kit;
    if (forced && drawn != *forced) continue;
    Draft draft(seed, drawn);
    std::vector<const Feature*> all = {&a, &b};
    std::stable_sort(all.begin(), all.end(),
                     [](const Feature* x, const Feature* y) { return x->rank < y->rank; });
    std::string why;
    for (const Feature* f : all)
      if (why.empty() && (f->needs_nodes && !draft.has_nodes() && !forced))
        why = fmt::format("{}: no nodes", f->name);
    for (const Feature* f : all)
      if (why.empty()) why = f->add(draft);
    if (!why.empty()) {
      result.why = why;
      continue;
    }
    for (int k = 0; k < beside; ++k) {
      const Feature& more =
          features[static_cast<std::size_t>(draft.draw.integer(0, static_cast<int>(features.size()) - 1))];
      const bool fits = &more != &a && &more != &b && more.check == Check::related && !more.kit &&
                        more.rank >= 4 && std::string(more.group) != "engine" && !are_alternatives(more, a) &&
                        !are_alternatives(more, b) && (draft.has_nodes() || !more.needs_nodes);
      if (fits) static_cast<void>(more.add(draft));
    }
    const std::string own = draft.parameter;
    result.text = draft.text();
    result.parameter = own;
    return result;
  }
  return result;
}

}  // namespace signorini::differential
