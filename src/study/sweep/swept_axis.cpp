#include "study/sweep/swept_axis.hpp"

#include <algorithm>
#include <map>

#include "base/number.hpp"
#include "result/picture.hpp"

namespace signorini {
namespace {

/// True for the key of the axis, or one in step with it.
bool moves_with(const SweepSpec& spec, const SweptAxis& axis, std::size_t key) {
  return key == axis.key || (axis.vary->group != 0 && spec.vary[key].group == axis.vary->group);
}

}  // namespace

std::string SweptAxis::x(const SweepRow& row) const {
  if (numbers) return shortest(*parse_number(row.values[key]));
  const auto& values = vary->values;
  return std::to_string(std::find(values.begin(), values.end(), row.values[key]) - values.begin());
}

SweptAxis axis_of(const SweepSpec& spec, bool last) {
  SweptAxis axis;
  for (std::size_t i = spec.vary.size(); i-- > 0;) {
    if (spec.vary[i].values.size() < 2) continue;
    axis.key = i;
    if (last) break;
  }
  axis.vary = &spec.vary[axis.key];
  axis.numbers = std::all_of(axis.vary->values.begin(), axis.vary->values.end(),
                             [](const std::string& value) { return parse_number(value).has_value(); });
  return axis;
}

std::vector<SweptCurve> swept_curves(const SweepSpec& spec, const SweepRows& rows, const SweptAxis& axis) {
  std::vector<SweptCurve> list;
  std::map<std::vector<std::string>, std::size_t> known;
  for (const auto& [index, row] : rows) {
    if (!row.ran()) continue;
    std::vector<std::string> others = row.values;
    for (std::size_t i = spec.vary.size(); i-- > 0;)
      if (moves_with(spec, axis, i)) others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const auto [found, fresh] = known.emplace(others, list.size());
    if (fresh) {
      std::string name;
      for (std::size_t i = 0; i < row.values.size(); ++i) {
        if (moves_with(spec, axis, i) || spec.vary[i].values.size() < 2) continue;
        name += (name.empty() ? "" : ", ") + row.values[i];
      }
      list.push_back({name, {}});
    }
    list[found->second].rows.push_back(&row);
  }
  return list;
}

std::string other_keys(const SweepSpec& spec, const SweptAxis& axis) {
  std::string text;
  for (std::size_t i = 0; i < spec.vary.size(); ++i)
    if (!moves_with(spec, axis, i) && spec.vary[i].values.size() > 1)
      text += (text.empty() ? "; curves: " : ", ") + spec.vary[i].path;
  return text;
}

std::string x_range(const SweptAxis& axis) {
  double first = 0.0, last = static_cast<double>(axis.vary->values.size()) - 1.0;
  if (axis.numbers) {
    first = last = *parse_number(axis.vary->values.front());
    for (const std::string& value : axis.vary->values) {
      first = std::min(first, *parse_number(value));
      last = std::max(last, *parse_number(value));
    }
  }
  const double air = last > first ? 0.03 * (last - first) : 1.0;
  return range_of('x', first - air, last + air);
}

}  // namespace signorini
