#include "published/figure.hpp"

#include <cstdlib>

namespace signorini::published {

std::vector<Case> all_cases() {
  std::vector<Case> all;
  for (const auto& group :
       {code_aster_friction, code_aster_impact, den_hartog, pascal, housner, newmark, textbook})
    for (Case& c : group()) all.push_back(std::move(c));
  return all;
}

double error(const Figure& figure, double ours) {
  const Real off = std::abs(static_cast<Real>(ours) - figure.exact);
  return static_cast<double>(figure.exact == 0.0L ? off : off / std::abs(figure.exact));
}

double last_digits_off(const Figure& figure) {
  if (figure.printed.empty()) return -1.0;
  const std::string& text = figure.printed;
  const std::size_t e = text.find('e'), point = text.find('.');
  const std::size_t digits = point == std::string::npos ? 0 : std::min(e, text.size()) - point - 1;
  const int power = e == std::string::npos ? 0 : std::atoi(text.c_str() + e + 1);
  const Real unit = std::pow(10.0L, static_cast<Real>(power) - static_cast<Real>(digits));
  return static_cast<double>(std::abs(std::strtold(text.c_str(), nullptr) - figure.exact) / unit);
}

}  // namespace signorini::published
