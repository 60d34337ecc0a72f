#include "sensitivity/parameter.hpp"

#include <fmt/core.h>
#include <toml++/toml.h>

#include <cmath>
#include <set>

#include "base/text.hpp"
#include "scene/keys.hpp"
#include "scene/overrides.hpp"
#include "scene/quantities.hpp"

namespace signorini::sensitivity {
namespace {

[[noreturn]] void fail_at(const std::string& path, const std::string& message) {
  throw UsageError(fmt::format("--parameter {}: {}", path, message));
}

/// True for a key run.initial.NODE.ux (or another component), whose value is zero if it is omitted.
bool is_initial_value(const std::vector<std::string>& parts) {
  return parts.size() == 4 && parts[0] == "run" && parts[1] == "initial" &&
         scene::find_key("run.initial.*", parts[3]) != nullptr;
}

void numbers_at(const toml::node& node, const std::vector<std::string>& rest, std::size_t next,
                const std::string& path, std::set<double>& found) {
  if (next == rest.size()) {
    if (const auto* both = node.as_table(); both && rest.back() == "friction") {
      for (const char* key : {"static", "kinetic", "slow", "fast"})
        if (const auto f = (*both)[key].value<double>()) found.insert(*f);
      for (const FrictionConstant& constant : friction_constants)
        if (both->contains(constant.key))
          fail_at(path, fmt::format("found a table of several friction numbers, expected friction.{}, "
                                    "friction.{} or friction.{}",
                                    both->contains("slow") ? "slow" : "static",
                                    both->contains("slow") ? "fast" : "kinetic", constant.key));
      return;
    }
    const auto number = node.value<double>();
    if (!number || node.is_boolean())
      fail_at(path, "found a value that is not a number, expected a key with a number");
    found.insert(*number);
    return;
  }
  const std::string& name = rest[next];
  if (const auto* table = node.as_table()) {
    const toml::node* inner = table->get(name);
    if (!inner && is_initial_value(rest)) {
      found.insert(0.0);
      return;
    }
    if (!inner)
      fail_at(path, fmt::format("the scene has no \"{}\". If this key has no default, add it to the scene "
                                "with the value at which to differentiate",
                                name));
    numbers_at(*inner, rest, next + 1, path, found);
  } else if (const auto* array = node.as_array()) {
    const auto index = base::parse_integer(name);
    bool any = false;
    for (std::size_t i = 0; i < array->size(); ++i) {
      const auto* entry = (*array)[i].as_table();
      const bool named = entry && (*entry)["name"].value<std::string>() == name;
      if (name != "*" && !named && !(index && *index == static_cast<long long>(i) + 1)) continue;
      any = true;
      numbers_at((*array)[i], rest, next + 1, path, found);
    }
    if (!any) fail_at(path, fmt::format("the scene has no \"{}\"", name));
  } else if (const auto number = node.value<double>(); number && rest[next - 1] == "friction") {
    found.insert(*number);  // friction = 0.3 sets both coefficients
  } else {
    fail_at(path,
            fmt::format("\"{}\" is a single value, expected a path that ends with this key", rest[next - 1]));
  }
}

std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

}  // namespace

Override set_to(const std::string& path, double x) { return {path, base::format_number(x)}; }

double value_of(const Scene& scene, const std::string& path) {
  toml::table root;
  try {
    root = toml::parse(scene.resolved);
  } catch (const toml::parse_error& error) {
    fail_at(path, std::string("the resolved scene cannot be read: ") + std::string(error.description()));
  }
  std::set<double> found;
  for (const std::string& meant : scene::matching_paths(root, path))
    numbers_at(root, parts_of(meant), 0, path, found);
  if (found.size() != 1) {
    const std::string met = scene::count_matching_tables(root, path);
    fail_at(path, fmt::format("found {} different numbers, from {} to {}{}; expected one number",
                              found.size(), base::format_number(*found.begin()),
                              base::format_number(*found.rbegin()), met.empty() ? "" : ", in " + met));
  }
  if (!std::isfinite(*found.begin())) fail_at(path, "expected a finite number");
  return *found.begin();
}

double typical_size(const SceneReader& read, const Scene& scene, const Model& model,
                    const std::string& path) {
  constexpr double probe = 1.0 / 1024.0;  // any small nonzero number
  std::vector<double> before;
  Scene copy = scene;
  scene::visit_quantities(copy, [&](double& x, const Unit&) { before.push_back(x); });
  const double time = model.scales.displacement / model.scales.velocity;
  const Factors typical{model.scales.force, model.scales.displacement, time};
  for (const double x : {probe, -probe}) {
    try {
      Scene moved = read({set_to(path, x)});
      std::size_t i = 0;
      double size = 1.0;
      scene::visit_quantities(moved, [&](double& y, const Unit& of) {
        if (i < before.size() && y != before[i]) size = scene::factor_of(of, typical);
        ++i;
      });
      return size;
    } catch (const Error&) {  // the key may allow only one sign
    }
  }
  return 1.0;
}

}  // namespace signorini::sensitivity
