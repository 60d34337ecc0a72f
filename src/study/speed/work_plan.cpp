#include "study/speed/work_plan.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "signorini/error.hpp"

namespace signorini::speed {
namespace {

constexpr double most_values = 100;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

double positive(const std::string& option, const std::string& text) {
  const std::optional<double> number = base::parse_number(text);
  if (!number || !std::isfinite(*number) || !(*number > 0.0))
    throw UsageError(fmt::format("{}: found \"{}\", expected a number > 0", option, text));
  return *number;
}

}  // namespace

double rounded_decimal(double value) { return *base::parse_number(fmt::format("{:.12g}", value)); }

std::vector<double> parse_decades(const std::string& option, const std::string& text) {
  const std::string given = option + " " + text;
  const std::vector<std::string> parts = split(text, ':');
  std::vector<double> values;
  if (parts.size() == 1) {
    for (const std::string& part : split(text, ',')) values.push_back(positive(given, part));
  } else if (parts.size() <= 3) {
    const double start = positive(given, parts[0]), stop = positive(given, parts[1]);
    const double factor = parts.size() == 3 ? positive(given, parts[2]) : 10.0;
    if (!(factor > 1.0))
      throw UsageError(fmt::format("{}: found the factor {}, expected more than 1", given, parts[2]));
    // A stop that is reached up to rounding is included.
    const double count = std::floor(std::abs(std::log(stop / start)) / std::log(factor) + 1e-9) + 1.0;
    if (!(count <= most_values))
      throw UsageError(fmt::format("{}: makes {:.0f} values, expected at most 100", given, count));
    for (double k = 0.0; k < count; ++k)
      values.push_back(rounded_decimal(start * std::pow(factor, stop < start ? -k : k)));
  } else {
    throw UsageError(
        fmt::format("{}: found {} numbers between colons, expected start:stop or start:stop:factor", given,
                    parts.size()));
  }
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::count(values.begin(), values.end(), values[i]) > 1)
      throw UsageError(fmt::format("{}: {} is given twice", given, base::format_number(values[i])));
  return values;
}

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
  const std::optional<Engine> known = find_engine(engine);
  return known ? std::string(signorini::accuracy_key(engine_info(*known).accuracy)) : "";
}

std::string WorkPoint::setting() const {
  const std::string key = accuracy_key(engine);
  const std::string own =
      accuracy ? key.substr(key.find('.') + 1) + "=" + base::format_number(*accuracy) : "";
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
  if (accuracy) list.push_back({accuracy_key(engine), base::format_number(*accuracy)});
  list.insert(list.end(), varied.begin(), varied.end());
  return list;
}

std::vector<WorkPoint> work_points(const WorkRanges& ranges) {
  std::vector<WorkPoint> points;
  for (const std::string& engine : ranges.engines) {
    const std::string key = accuracy_key(engine);
    for (const auto& varied : ranges.varied) {
      if (key.empty()) points.push_back({engine, std::nullopt, varied});
      for (const double value : key == signorini::accuracy_key(Accuracy::step) ? ranges.dt : ranges.rtol)
        if (!key.empty()) points.push_back({engine, value, varied});
    }
  }
  return points;
}

std::vector<double> usual_steps(double t_end) {
  const double first = std::pow(10.0, std::floor(std::log10(t_end / 50.0) + 1e-9));
  return parse_decades("--dt", base::format_number(first) + ":" + base::format_number(first * 1e-4));
}

}  // namespace signorini::speed
