// [reduction]: the cutoff, in cycles or in radians per time, or the tolerance from which it is found.
#include <numbers>

#include "scene/readers.hpp"

namespace signorini {

void read_reduction(Table& top, Scene& scene, RecordedScene& record) {
  if (!top.has("reduction")) return;
  Table table = top.child("reduction");
  if (table.has("cutoff_frequency") && table.has("cutoff_omega"))
    table.fail("cutoff_frequency", "cannot be combined with cutoff_omega; give only one of them");
  ReductionSpec spec;
  spec.place = table.place();
  for (const char* cutoff : {"cutoff_frequency", "cutoff_omega"})
    if (table.has("tolerance") && table.has(cutoff))
      table.fail("tolerance", std::string("stands beside ") + cutoff + ", expected one of the two");
  if (const auto tolerance = table.optional_number("tolerance")) {
    spec.tolerance = *tolerance;
  } else if (const auto frequency = table.optional_number("cutoff_frequency")) {
    spec.cutoff_omega = 2.0 * std::numbers::pi * *frequency;
  } else {
    table.require("cutoff_omega", " (give one of cutoff_omega, cutoff_frequency and tolerance)");
    spec.cutoff_omega = *table.optional_number("cutoff_omega");
  }
  table.finish();
  scene.reduction = spec;
  record.add("reduction", "[reduction]", table.record());
}

}  // namespace signorini
