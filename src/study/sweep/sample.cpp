#include "study/sweep/sample.hpp"

#include <fmt/core.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_qrng.h>
#include <gsl/gsl_rng.h>

#include <cmath>
#include <functional>
#include <memory>

#include "base/excerpt.hpp"
#include "base/number.hpp"
#include "signorini/error.hpp"

namespace signorini {
namespace {

constexpr int sample_group = 1'000'000;  // group of all sampled keys: larger than any number of --together
constexpr std::size_t most_samples = 1'000'000, most_sobol_keys = 40;

/// The value at the probability u, 0 < u < 1.
using Inverse = std::function<double(double u)>;

struct Distribution {
  const char *name, *parameters;
  std::size_t count;
  /// Null function if the parameters are invalid.
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
    throw UsageError(option + ": expected PATH=DISTRIBUTION(numbers), one of " + known);
  const std::string name = trimmed(text.substr(0, open));
  std::vector<double> numbers;
  std::string inside = text.substr(open + 1, text.size() - open - 2) + ",";
  for (std::size_t comma; (comma = inside.find(',')) != std::string::npos; inside.erase(0, comma + 1)) {
    const std::string word = trimmed(inside.substr(0, comma));
    const std::optional<double> number = parse_number(word);
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

/// Adds "a,b" as two keys; the second one's text marks it as sharing the draw of the first.
void add_keys(const std::string& paths, const std::string& distribution, const std::string& option,
              std::vector<Vary>& varied) {
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

/// Excludes 0 and 1, where a normal variable would be infinite.
double inner(double u) { return std::min(std::max(u, 0x1p-54), 1.0 - 0x1p-53); }

}  // namespace

std::vector<Vary> draw_samples(const std::vector<std::string>& texts, const SampleSpec& spec) {
  std::vector<Vary> varied;
  std::vector<Inverse> inverses;
  std::vector<std::size_t> draw_of;  // per key: keys of one text share their draw
  for (const std::string& text : texts) {
    const std::string option = "--sample " + text;
    if (!is_plain_text(text))
      throw UsageError(excerpt(option) + ": found bytes that are no plain UTF-8 text");
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
      throw UsageError(option + ": expected PATH=DISTRIBUTION, such as contacts.*.friction=normal(0.4,0.05)");
    const std::string distribution = text.substr(equals + 1);
    inverses.push_back(parse_distribution(distribution, option));
    add_keys(text.substr(0, equals), distribution, option, varied);
    draw_of.resize(varied.size(), inverses.size() - 1);
  }
  if (varied.empty()) return varied;
  if (spec.count < 1 || spec.count > most_samples)
    throw UsageError(fmt::format("--samples {}: expected 1 to {}", spec.count, most_samples));
  if (spec.sequence == Sequence::sobol && inverses.size() > most_sobol_keys)
    throw UsageError(fmt::format("--sequence sobol: found {} sampled values, expected at most {}",
                                 inverses.size(), most_sobol_keys));
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
            fmt::format("--sample {}={}: draw {} is no finite number, expected a distribution "
                        "within the range of numbers",
                        varied[k].path, varied[k].text, i + 1));
      varied[k].values.push_back(shortest(value));
    }
  }
  return varied;
}

}  // namespace signorini
