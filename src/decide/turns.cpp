#include "decide/turns.hpp"

#include <algorithm>
#include <limits>

#include "base/rounding.hpp"

namespace signorini {

std::vector<std::size_t> next_turn(std::vector<Approach>& all) {
  double soonest = std::numeric_limits<double>::infinity();
  for (const Approach& a : all)
    if (a.closes()) soonest = std::min(soonest, a.gap / -a.rate);
  std::vector<std::size_t> struck;
  if (soonest == std::numeric_limits<double>::infinity()) return struck;
  for (Approach& a : all) {
    const bool rests = a.gap == 0.0 && a.rate <= a.rest;
    const double gap = rests ? 0.0 : a.gap + a.rate * soonest;
    a.gap = gap > rounding::of_few * a.gap ? gap : 0.0;  // rounding of a product and a difference
    if (a.gap == 0.0 && (a.closes() || a.rate <= a.rest)) struck.push_back(a.contact);
  }
  return struck;
}

}  // namespace signorini
