#include "run/output_value.hpp"

#include <algorithm>
#include <cmath>

namespace signorini {
namespace {

double given_at(const Output::Given& given, double t, Side side) {
  return (side == Side::after ? given.history.piece(t) : given.history.piece_before(t)).value(t);
}

double restored(const Output::Restoring& r, const Point& point, const ForceLayout& layout) {
  return r.factor * (-point.N(layout, r.contact) - r.said) * r.slip.dot(point.u);
}

void take(OutputReading& all, const OutputReading& part) {
  if (part.greatest > all.greatest) all.greatest = part.greatest, all.at_greatest = part.at_greatest;
  if (part.least < all.least) all.least = part.least, all.at_least = part.at_least;
}

}  // namespace

double value_of(const Output& output, double t, Side side, const Point& point, const ForceLayout& layout,
                const std::vector<double>& losses) {
  if (output.loss) return *output.loss < losses.size() ? losses[*output.loss] : 0.0;
  double sum = output.constant + output.u.dot(point.u) + output.v.dot(point.v);
  if (!output.a.terms.empty() && point.a.size() > 0) sum += output.a.dot(point.a);
  for (const Output::ContactForces& f : output.forces)
    sum += f.N * point.N(layout, f.contact) + f.T * point.T(layout, f.contact);
  for (const Output::Restoring& r : output.restoring) sum += restored(r, point, layout);
  for (const Output::Given& g : output.given) sum += given_at(g, t, side);
  return sum;
}

OutputReading along_stretch(const Output& output, std::size_t i, const Along::Values& values) {
  const Output::Stretch& stretch = output.stretches[i];
  const Along::Extremes e = Along::extremes(values, stretch.at.size());
  const auto place = [&](double x) {
    return OutputPlace{static_cast<int>(i), stretch.begin + x * (stretch.end - stretch.begin)};
  };
  return {std::max(e.greatest, -e.least), e.greatest, e.least, place(e.at_greatest), place(e.at_least)};
}

OutputReading reading_of(const Output& output, double t, Side side, const Point& point,
                         const ForceLayout& layout, const std::vector<double>& losses) {
  OutputReading all;
  if (output.stretches.empty()) {
    all.value = all.greatest = all.least = value_of(output, t, side, point, layout, losses);
    return all;
  }
  for (std::size_t i = 0; i < output.stretches.size(); ++i) {
    const std::vector<Output>& at = output.stretches[i].at;
    Along::Values values{};
    for (std::size_t j = 0; j < at.size(); ++j) values[j] = value_of(at[j], t, side, point, layout, losses);
    const OutputReading part = along_stretch(output, i, values);
    if (i == 0)
      all = part;
    else
      take(all, part);
  }
  all.value = std::max(all.greatest, -all.least);
  return all;
}

double magnitude_of(const Output& output, double t, Side side, const Point& point,
                    const ForceLayout& layout) {
  double sum = std::abs(output.constant) + output.u.magnitude(point.u) + output.v.magnitude(point.v);
  if (!output.a.terms.empty() && point.a.size() > 0) sum += output.a.magnitude(point.a);
  for (const Output::ContactForces& f : output.forces)
    sum += std::abs(f.N * point.N(layout, f.contact)) + std::abs(f.T * point.T(layout, f.contact));
  for (const Output::Restoring& r : output.restoring) sum += std::abs(restored(r, point, layout));
  for (const Output::Given& g : output.given) sum += std::abs(given_at(g, t, side));
  return sum;
}

}  // namespace signorini
