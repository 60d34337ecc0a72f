#include "study/sweep/parameter_range.hpp"

#include <fmt/core.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_qrng.h>
#include <gsl/gsl_rng.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>

#include "base/text.hpp"
#include "scene/overrides.hpp"
#include "signorini/error.hpp"

namespace signorini::sweep {
namespace {

constexpr double most_points = 1e6;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  int depth = 0;
  char quote = 0;
  for (const char c : text) {
    if (quote != 0) {
      quote = c == quote ? '\0' : quote;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == separator && depth == 0) {
      parts.emplace_back();
      continue;
    }
    parts.back() += c;
  }
  return parts;
}

/// Number of decimals that write the number exactly: 0.1 has one, 1e-3 three, 20 none.
int decimals(const std::string& number) {
  const std::size_t e = number.find_first_of("eE"), point = number.find('.');
  const std::string mantissa = number.substr(0, e);
  const int after = point == std::string::npos ? 0 : static_cast<int>(mantissa.size() - point - 1);
  const auto exponent = e == std::string::npos ? 0 : base::parse_integer(number.substr(e + 1)).value_or(0);
  return static_cast<int>(std::clamp<long long>(after - exponent, 0, 99));
}

/// start + k step, rounded to the decimals that a user would write.
double stepped(double start, double step, double k, int digits) {
  const double value = start + k * step;
  constexpr int most_digits = 15;
  if (digits > most_digits) return value;
  const double scale = std::pow(10.0, digits);
  constexpr double most_exact = 9e15;  // larger integers are not all exact in double precision
  const double scaled = std::round(value * scale);
  return std::abs(scaled) < most_exact ? scaled / scale : value;
}

std::vector<std::string> range(const std::string& option, const std::vector<std::string>& parts) {
  double numbers[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<double> number = base::parse_number(parts[i]);
    if (!number || !std::isfinite(*number))
      throw UsageError(
          fmt::format("{}: found \"{}\" in start:stop:step, expected a number", option, parts[i]));
    numbers[i] = *number;
  }
  const auto [start, stop, step] = numbers;
  if (step == 0.0 || (stop - start) / step < 0.0)
    throw UsageError(fmt::format("{}: steps of {} from {} never reach {}; check the sign of the step", option,
                                 parts[2], parts[0], parts[1]));
  // A stop that is a multiple of the step up to rounding is included.
  const double steps = std::floor((stop - start) / step * (1.0 + 1e-12) + 1e-9);
  if (!(steps < most_points))
    throw UsageError(
        fmt::format("{}: found {:.6g} values, expected at most 1e6 values", option, steps + 1.0));
  const int digits = std::max(decimals(parts[0]), decimals(parts[2]));
  const bool integers = std::all_of(parts.begin(), parts.end(), [](const std::string& part) {
    return base::parse_integer(part).has_value();
  });
  std::vector<std::string> values;
  for (double k = 0.0; k <= steps; ++k) {
    const double value = stepped(start, step, k, digits);
    values.push_back(integers ? fmt::format("{:.0f}", value)
                              : base::format_number(value == 0.0 ? 0.0 : value));
  }
  return values;
}

/// A round step (1, 2 or 5 times a power of ten) that divides the interval into about four parts.
double round_step(double from, double to) {
  const double quarter = 0.25 * std::abs(to - from);
  if (!(quarter > 0.0)) return 1.0;
  const double ten = std::pow(10.0, std::floor(std::log10(quarter) + 1e-9));
  const double digit = quarter / ten;
  const double step = (digit < 1.5 ? 1.0 : digit < 3.5 ? 2.0 : digit < 7.5 ? 5.0 : 10.0) * ten;
  return to < from ? -step : step;
}

/// Example of a range with these ends: "0.1:0.5:0.1" from 0.1 and 0.5.
std::string example_of(const std::string& from, const std::string& to) {
  return fmt::format("{}:{}:{:.3g}", from, to,
                     round_step(*base::parse_number(from), *base::parse_number(to)));
}

/// Refuses 0.1-0.5 and 0.1..0.5, which are common notations of ranges, but never values of a key.
void refuse_other_ranges(const std::string& option, const std::string& value) {
  for (const char* between : {"..", "-", " to "}) {
    for (std::size_t at = value.find(between, 1); at != std::string::npos; at = value.find(between, at + 1)) {
      const std::string from = value.substr(0, at), to = value.substr(at + std::string_view(between).size());
      if (base::parse_number(from) && base::parse_number(to))
        throw UsageError(fmt::format("{}: found \"{}\", expected start:stop:step, such as {}", option, value,
                                     example_of(from, to)));
    }
  }
}

}  // namespace

ParameterRange parse_vary(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string option = "--vary " + text;
  if (!base::is_plain_text(text))
    throw UsageError(base::excerpt(option) + ": found bytes that are not plain UTF-8 text");
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    throw UsageError(option + ": expected path=start:stop:step or path=value,value,...");
  ParameterRange vary{text.substr(0, equals), text.substr(equals + 1), {}};
  const std::vector<std::string> parts = split(vary.text, ':');
  if (parts.size() == 3 && split(vary.text, ',').size() == 1) {
    vary.values = range(option, parts);
    return vary;
  }
  if (parts.size() > 1 && std::all_of(parts.begin(), parts.end(),
                                      [](const std::string& p) { return base::parse_number(p).has_value(); }))
    throw UsageError(fmt::format("{}: found {} numbers between colons, expected start:stop:step, such as {}",
                                 option, parts.size(), example_of(parts[0], parts[1])));
  vary.values = split(vary.text, ',');
  for (std::string& value : vary.values) {
    const std::size_t first = value.find_first_not_of(' ');
    if (first == std::string::npos) throw UsageError(option + ": found an empty value between commas");
    value = value.substr(first, value.find_last_not_of(' ') - first + 1);
    refuse_other_ranges(option, value);
  }
  return vary;
}

namespace {

/// Indices of the keys in the group of key i, key i first; empty if an earlier key belongs to this group.
std::vector<std::size_t> in_step(const std::vector<ParameterRange>& varied, std::size_t i) {
  std::vector<std::size_t> members{i};
  if (varied[i].group == 0) return members;
  for (std::size_t j = 0; j < varied.size(); ++j) {
    if (j == i || varied[j].group != varied[i].group) continue;
    if (j < i) return {};
    members.push_back(j);
    if (varied[j].values.size() != varied[i].values.size())
      throw UsageError(fmt::format("--together: {} has {} and {} has {}, expected equally many values",
                                   varied[i].path, base::count_text(varied[i].values.size(), "value"),
                                   varied[j].path, varied[j].values.size()));
  }
  return members;
}

}  // namespace

const char* option_of(const ParameterRange& vary) { return vary.sampled ? "sample" : "vary"; }

Override override_of(const ParameterRange& vary, const std::string& value) {
  return {vary.path, value, fmt::format("--{} {}={}", option_of(vary), vary.path, value)};
}

void check_overlaps(const std::string& scene, const std::vector<ParameterRange>& varied,
                    const std::vector<Override>& settings) {
  std::vector<std::vector<std::string>> places;
  for (const ParameterRange& vary : varied) {
    places.push_back(scene::places_in(scene, vary.path));
    for (std::size_t j = 0; j + 1 < places.size(); ++j)
      for (const std::string& a : places.back())
        for (const std::string& b : places[j])
          if (scene::is_within_path(a, b) || scene::is_within_path(b, a))
            throw UsageError(fmt::format("--{} {}={}: --{} {} varies {} already", option_of(vary), vary.path,
                                         vary.text, option_of(varied[j]), varied[j].path,
                                         a == b ? "this key" : "an overlapping key"));
  }
  for (const Override& setting : settings) {
    const std::vector<std::string> set = scene::places_in(scene, setting.path);
    std::size_t lost = 0;
    const ParameterRange* by = nullptr;
    for (const std::string& a : set)
      for (std::size_t j = 0; j < places.size(); ++j)
        if (std::any_of(places[j].begin(), places[j].end(),
                        [&](const std::string& b) { return scene::is_within_path(a, b); })) {
          ++lost;
          by = &varied[j];
          break;
        }
    if (by && lost == set.size())
      throw UsageError(fmt::format("{}: has no effect, because --{} {} sets this key in every run",
                                   scene::override_text(setting), option_of(*by), by->path));
  }
}

std::vector<std::vector<Override>> points(const std::vector<ParameterRange>& varied) {
  double count = 1.0;
  for (std::size_t i = 0; i < varied.size(); ++i) {
    if (!in_step(varied, i).empty()) count *= static_cast<double>(varied[i].values.size());
    for (std::size_t j = 0; j < i; ++j)
      if (varied[j].path == varied[i].path)
        throw UsageError(fmt::format("--{} {}={}: this key is varied already", option_of(varied[i]),
                                     varied[i].path, varied[i].text));
  }
  if (count > most_points)
    throw UsageError(fmt::format("--vary: the ranges make {:.0f} runs, expected at most 1e6", count));
  std::vector<std::vector<Override>> list(1, std::vector<Override>(varied.size()));
  for (std::size_t i = 0; i < varied.size(); ++i) {
    const std::vector<std::size_t> members = in_step(varied, i);
    if (members.empty()) continue;
    std::vector<std::vector<Override>> longer;
    longer.reserve(list.size() * varied[i].values.size());
    for (const auto& point : list) {
      for (std::size_t k = 0; k < varied[i].values.size(); ++k) {
        longer.push_back(point);
        for (const std::size_t j : members) longer.back()[j] = override_of(varied[j], varied[j].values[k]);
      }
    }
    list = std::move(longer);
  }
  return list;
}

namespace {

constexpr int sample_group = 1'000'000;  // group of all sampled keys: larger than any number of --together
constexpr std::size_t max_samples = 1'000'000, max_sobol_keys = 40;

/// Inverse of a cumulative distribution function: the value at the probability u, 0 < u < 1.
using Inverse = std::function<double(double u)>;

struct Distribution {
  const char *name, *parameters;
  std::size_t count;
  /// Returns a null function if the parameters are invalid.
  Inverse (*make)(const std::vector<double>& p);
};

Inverse normal(const std::vector<double>& p) {
  if (!(p[1] > 0.0)) return {};
  return [=](double u) { return p[0] + gsl_cdf_gaussian_Pinv(u, p[1]); };
}
Inverse lognormal(const std::vector<double>& p) {
  if (!(p[0] > 0.0) || !(p[1] > 0.0)) return {};
  const double square = std::log1p(p[1] / p[0] * (p[1] / p[0]));
  return [m = std::log(p[0]) - 0.5 * square, s = std::sqrt(square)](double u) {
    return std::exp(m + gsl_cdf_gaussian_Pinv(u, s));
  };
}
Inverse uniform(const std::vector<double>& p) {
  if (!(p[0] < p[1])) return {};
  return [=](double u) { return p[0] + u * (p[1] - p[0]); };
}
Inverse triangular(const std::vector<double>& p) {
  if (!(p[0] <= p[1] && p[1] <= p[2] && p[0] < p[2])) return {};
  return [=](double u) {
    const double width = p[2] - p[0], rise = (p[1] - p[0]) / width;
    return u < rise ? p[0] + std::sqrt(u * width * (p[1] - p[0]))
                    : p[2] - std::sqrt((1.0 - u) * width * (p[2] - p[1]));
  };
}

constexpr Distribution distributions[] = {
    {"normal", "(mean, standard deviation > 0)", 2, normal},
    {"lognormal", "(mean > 0, standard deviation > 0)", 2, lognormal},
    {"uniform", "(from, to), from < to", 2, uniform},
    {"triangular", "(least, most likely, greatest), ascending", 3, triangular},
};

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

Inverse parse_distribution(const std::string& text, const std::string& option) {
  std::string known;
  for (const Distribution& d : distributions) known += fmt::format("{}{}", known.empty() ? "" : ", ", d.name);
  const std::size_t open = text.find('(');
  if (open == std::string::npos || text.back() != ')')
    throw UsageError(option +
                     ": expected PATH=DISTRIBUTION(numbers) with one of these distributions: " + known);
  const std::string name = trimmed(text.substr(0, open));
  std::vector<double> numbers;
  std::string inside = text.substr(open + 1, text.size() - open - 2) + ",";
  for (std::size_t comma; (comma = inside.find(',')) != std::string::npos; inside.erase(0, comma + 1)) {
    const std::string word = trimmed(inside.substr(0, comma));
    const std::optional<double> number = base::parse_number(word);
    if (!number || !std::isfinite(*number))
      throw UsageError(fmt::format("{}: found \"{}\", expected a number", option, word));
    numbers.push_back(*number);
  }
  for (const Distribution& d : distributions) {
    if (name != d.name) continue;
    Inverse inverse = numbers.size() == d.count ? d.make(numbers) : Inverse{};
    if (!inverse) throw UsageError(fmt::format("{}: expected {}{}", option, d.name, d.parameters));
    return inverse;
  }
  throw UsageError(fmt::format("{}: unknown distribution \"{}\", expected one of {}", option, name, known));
}

/// Adds the keys of "a,b". The text of each further key refers to the first one, whose draw it shares.
void add_keys(const std::string& paths, const std::string& distribution, const std::string& option,
              std::vector<ParameterRange>& varied) {
  std::string first;
  std::string left = paths + ",";
  for (std::size_t comma; (comma = left.find(',')) != std::string::npos; left.erase(0, comma + 1)) {
    const std::string path = trimmed(left.substr(0, comma));
    if (path.empty()) throw UsageError(option + ": found an empty key between commas");
    varied.push_back(
        {path, first.empty() ? distribution : distribution + " as " + first, {}, sample_group, true});
    if (first.empty()) first = path;
  }
}

using Generator = std::unique_ptr<gsl_rng, void (*)(gsl_rng*)>;
using Sobol = std::unique_ptr<gsl_qrng, void (*)(gsl_qrng*)>;

/// Moves u away from 0 and 1, where a normal variable would be infinite.
double inner(double u) { return std::min(std::max(u, 0x1p-54), 1.0 - 0x1p-53); }

}  // namespace

std::vector<ParameterRange> draw_samples(const std::vector<std::string>& texts, const SampleSpec& spec) {
  std::vector<ParameterRange> varied;
  std::vector<Inverse> inverses;
  std::vector<std::size_t> draw_of;  // index of the draw for each key; keys of one text share a draw
  for (const std::string& text : texts) {
    const std::string option = "--sample " + text;
    if (!base::is_plain_text(text))
      throw UsageError(base::excerpt(option) + ": found bytes that are not plain UTF-8 text");
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
      throw UsageError(option + ": expected PATH=DISTRIBUTION, such as contacts.*.friction=normal(0.4,0.05)");
    const std::string distribution = text.substr(equals + 1);
    inverses.push_back(parse_distribution(distribution, option));
    add_keys(text.substr(0, equals), distribution, option, varied);
    draw_of.resize(varied.size(), inverses.size() - 1);
  }
  if (varied.empty()) return varied;
  if (spec.count < 1 || spec.count > max_samples)
    throw UsageError(fmt::format("--samples {}: expected 1 to {}", spec.count, max_samples));
  if (spec.sequence == Sequence::sobol && inverses.size() > max_sobol_keys)
    throw UsageError(fmt::format("--sequence sobol: found {} sampled values, expected at most {}",
                                 inverses.size(), max_sobol_keys));
  const Generator random(gsl_rng_alloc(gsl_rng_mt19937), gsl_rng_free);
  gsl_rng_set(random.get(), spec.seed);
  const std::size_t draws = inverses.size();
  std::vector<double> shift(draws), point(draws);
  const Sobol sobol(spec.sequence == Sequence::sobol
                        ? gsl_qrng_alloc(gsl_qrng_sobol, static_cast<unsigned>(draws))
                        : nullptr,
                    gsl_qrng_free);
  if (sobol)
    for (double& s : shift) s = gsl_rng_uniform(random.get());
  for (std::size_t i = 0; i < spec.count; ++i) {
    if (sobol) (void)gsl_qrng_get(sobol.get(), point.data());
    for (std::size_t j = 0; j < draws; ++j)
      if (!sobol) point[j] = gsl_rng_uniform(random.get());
    for (std::size_t k = 0; k < varied.size(); ++k) {
      const std::size_t j = draw_of[k];
      const double u = sobol ? std::fmod(point[j] + shift[j], 1.0) : point[j];
      const double value = inverses[j](inner(u));
      if (!std::isfinite(value))
        throw UsageError(
            fmt::format("--sample {}={}: draw {} is not a finite number, expected a distribution of finite "
                        "numbers",
                        varied[k].path, varied[k].text, i + 1));
      varied[k].values.push_back(base::format_number(value));
    }
  }
  return varied;
}

}  // namespace signorini::sweep
