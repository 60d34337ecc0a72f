#include "study/speed/work_plan.hpp"

#include <cmath>

#include "base/number.hpp"
#include "study/speed/decades.hpp"

namespace signorini {

namespace {

std::string text_of_varied(const WorkPoint& point) {
  std::string text;
  for (const Override& change : point.varied)
    text += (text.empty() ? "" : " ") + change.path + "=" + change.value;
  return text;
}

std::string joined(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() ? a + b : a + " " + b;
}

}  // namespace

std::string accuracy_key(const std::string& engine) {
  const std::optional<Engine> known = engine_called(engine);
  return known ? std::string(accuracy_key(name_of(*known).accuracy)) : "";
}

std::string WorkPoint::setting() const {
  const std::string key = accuracy_key(engine);
  const std::string own = accuracy ? key.substr(key.find('.') + 1) + "=" + shortest(*accuracy) : "";
  return joined(own, text_of_varied(*this));
}

std::string WorkPoint::name() const { return joined(engine, setting()); }

std::string WorkPoint::line() const { return joined(engine, text_of_varied(*this)); }

std::string WorkPoint::label() const {
  std::string text = engine;
  for (const Override& change : varied)
    text += " " + change.path.substr(change.path.rfind('.') + 1) + "=" + change.value;
  return text;
}

std::vector<Override> WorkPoint::changes() const {
  std::vector<Override> list = {{"run.engine", engine}};
  if (accuracy) list.push_back({accuracy_key(engine), shortest(*accuracy)});
  list.insert(list.end(), varied.begin(), varied.end());
  return list;
}

std::vector<WorkPoint> work_points(const WorkRanges& ranges) {
  std::vector<WorkPoint> points;
  for (const std::string& engine : ranges.engines) {
    const std::string key = accuracy_key(engine);
    for (const auto& varied : ranges.varied) {
      if (key.empty()) points.push_back({engine, std::nullopt, varied});
      for (const double value : key == accuracy_key(Accuracy::step) ? ranges.dt : ranges.rtol)
        if (!key.empty()) points.push_back({engine, value, varied});
    }
  }
  return points;
}

std::vector<double> usual_steps(double t_end) {
  const double first = std::pow(10.0, std::floor(std::log10(t_end / 50.0) + 1e-9));
  return parse_decades("--dt", shortest(first) + ":" + shortest(first * 1e-4));
}

}  // namespace signorini
