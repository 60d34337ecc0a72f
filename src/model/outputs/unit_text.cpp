#include "signorini/output.hpp"

namespace signorini {
namespace {

void add(std::string& text, const std::string& name, int power) {
  if (power <= 0) return;
  if (!text.empty()) text += ' ';
  text += name;
  if (power > 1) text += '^' + std::to_string(power);
}

}  // namespace

std::string unit_text(const Unit& unit, const Units& names) {
  std::string above, below;
  if (unit.force == 0 && unit.length == 0) above = "rad";
  add(above, names.force, unit.force);
  add(above, names.length, unit.length);
  add(above, names.time, unit.time);
  add(below, names.force, -unit.force);
  add(below, names.length, -unit.length);
  add(below, names.time, -unit.time);
  if (above.empty()) above = "1";
  return below.empty() ? above : above + '/' + below;
}

}  // namespace signorini
