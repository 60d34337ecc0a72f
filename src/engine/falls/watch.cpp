#include "engine/falls/watch.hpp"

#include <algorithm>

namespace signorini {
namespace {
constexpr double resolution = 1e-12;  // of a step; the engine refines on its dense output
}

void Watch::start(const std::vector<GuardStart>& guards, std::vector<double> levels) {
  kinds_.clear();
  forms_.clear();
  armed_.clear();
  for (const GuardStart& guard : guards) {
    kinds_.push_back(guard.kind);
    forms_.push_back(guard.form);
    armed_.push_back(guard.kind != Guard::none && !guard.at_zero);
  }
  levels_ = std::move(levels);
}

double Watch::leeway(std::size_t contact, const Form& form) const {
  const std::size_t first = guards_per_contact * contact;
  for (std::size_t slot = first; slot < std::min(first + guards_per_contact, kinds_.size()); ++slot)
    if (kinds_[slot] != Guard::none && forms_[slot] == form) return armed_[slot] ? 0.0 : levels_[slot];
  return 0.0;
}

std::vector<Fall> Watch::check(const StepHistory& history, double limit) {
  std::vector<Fall> falls;
  for (std::size_t slot = 0; slot < kinds_.size(); ++slot) {
    if (kinds_[slot] == Guard::none || (armed_[slot] && history.clearly_positive(slot))) continue;
    Bernstein p = history.polynomial(slot);
    if (armed_[slot] && p.positive()) continue;
    double from = 0.0;
    if (!armed_[slot]) {
      const double level = levels_[slot];
      const auto rise = first_reach(p, level, resolution);
      Bernstein negative = p;
      for (double& b : negative.b) b = -b;
      const auto sink = first_reach(negative, level, resolution);
      if (sink && (!rise || *sink < *rise)) {
        if (*sink <= limit) falls.push_back({slot, *sink});
        continue;
      }
      if (!rise) continue;
      armed_[slot] = true;
      from = *rise;
      Bernstein before, after;
      p.split(from, before, after);
      p = after;
    }
    if (const auto x = first_fall(p, resolution)) {
      const double at = from + (1.0 - from) * *x;
      if (at <= limit) falls.push_back({slot, at});
    }
  }
  return falls;
}

}  // namespace signorini
