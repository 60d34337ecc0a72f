#include "differential/scene_text.hpp"

namespace signorini::differential {
namespace {

template <class Items, class Text>
std::string joined(const Items& items, const char* open, const char* close, const Text& text) {
  std::string all;
  for (const auto& item : items) {
    const std::string one = text(item);
    if (!one.empty()) all += (all.empty() ? "" : ", ") + one;
  }
  return open + all + close;
}

Keys friction(Random& draw, const ContactKind& kind, bool shears) {
  const double mu = draw.one_of({0.0, 0.1, 0.3, 0.5, 0.8, draw.rounded(0.05, 1.0, 2)});
  if (mu == 0.0 || draw.chance(0.65)) return Keys().set("friction", mu);
  Keys two = Keys().set("static", mu).set("kinetic", rounded(mu * draw.real(0.4, 0.95), 3));
  if (kind.may_have_rate && !shears && draw.chance(0.5))
    two.set("stribeck_velocity", draw.rounded(0.05, 0.5, 2));
  return Keys().set("friction", two.braced());
}

std::string compression(Random& draw, double force) {
  const double mean = rounded(force * draw.one_of({0.3, 1.0, 2.0}), 3);
  if (draw.chance(0.6)) return fmt::format("{}", mean);
  return Keys()
      .name("type", "harmonic")
      .set("offset", mean)
      .set("amplitude", rounded(mean * draw.real(0.1, 0.9), 3))
      .set("omega", draw.rounded(3.0, 30.0, 2))
      .braced();
}

}  // namespace

std::string list(const std::vector<double>& values) {
  return joined(values, "[", "]", [](double x) { return fmt::format("{}", x); });
}

std::string rows(const std::vector<std::vector<double>>& matrix) {
  return joined(matrix, "[", "]", [](const std::vector<double>& row) { return list(row); });
}

std::string form(const std::vector<double>& factors) {
  int i = -1;
  return joined(factors, "{ ", " }", [&](double x) {
    ++i;
    return x == 0.0 ? std::string() : fmt::format("d{} = {}", i, x);
  });
}

std::string motion_history(Random& draw, double amplitude, double t_end) {
  const double size = rounded(amplitude * draw.real(0.3, 1.0), 4);
  Keys keys;
  switch (draw.integer(0, 2)) {
    case 0:
      keys.name("type", "harmonic")
          .set("amplitude", size)
          .set("omega", rounded(draw.real(5.0, 60.0) / t_end, 2));
      break;
    case 1:
      keys.name("type", "half_sine").set("amplitude", size);
      keys.set("start", rounded(draw.real(0.0, 0.4) * t_end, 3));
      keys.set("duration", rounded(draw.real(0.1, 0.5) * t_end, 3));
      break;
    default:
      keys.name("type", "table");
      keys.set("times",
               list({0.0, rounded(0.3 * t_end, 3), rounded(0.6 * t_end, 3), rounded(1.1 * t_end, 3)}));
      keys.set("values", list({0.0, size, rounded(-0.5 * size, 4), 0.0}));
  }
  return keys.braced();
}

Keys contact_laws(Random& draw, const ContactKind& kind) {
  constexpr double second = 1.0;
  Keys keys;
  const double stiffness = kind.stiffness * draw.one_of({0.1, 1.0, 10.0});
  bool shears = kind.law == "compliant";
  if (kind.law == "slider") {
    keys.set("normal_force", compression(draw, kind.force));
    shears = draw.chance(0.4);
    if (shears) keys.set("tangential_stiffness", stiffness);
  } else if (kind.law == "compliant") {
    keys.set("normal_stiffness", stiffness).set("tangential_stiffness", stiffness * draw.one_of({0.3, 1.0}));
    if (draw.chance(0.3)) keys.set("normal_damping", rounded(stiffness * 1e-3, 4));
    if (draw.chance(0.1)) keys.set("tangential_damping", rounded(stiffness * 1e-3, 4));
  } else {
    const double e = draw.one_of({0.0, 0.0, 0.5, 0.8, 1.0, draw.rounded(0.0, 1.0, 2)});
    keys.set("restitution", e);
    if (e > 0.0 && draw.chance(0.5)) keys.set("capture_velocity", draw.one_of({0.01, 0.003}));
  }
  keys.add(friction(draw, kind, shears));
  if (draw.chance(0.25)) {
    if (draw.chance(0.5))
      keys.set("surface_velocity", draw.one_of({0.2, -0.5}));
    else
      keys.set("surface_velocity", motion_history(draw, 0.5, second));
  }
  return keys;
}

Keys load_course(Random& draw, double size, double t_end) {
  Keys load = Keys().set("amplitude", rounded(size * draw.real(0.3, 1.0), 2));
  const auto within = [&](double low, double high) { return rounded(draw.real(low, high) * t_end, 3); };
  const int shape = draw.integer(0, 6);
  const double start = within(0.0, 0.5);
  Keys keys;
  switch (shape) {
    case 0:
    case 1:
      keys.name("type", "harmonic").set("omega", rounded(draw.real(3.0, 80.0) / t_end, 2));
      keys.set("phase", draw.one_of({0.0, 1.0}));
      break;
    case 2:
      keys.name("type", "half_sine").set("start", start).set("duration", within(0.03, 0.4));
      break;
    case 3:
      keys.name("type", "step").set("start", start);
      break;
    case 4:
      keys.name("type", "rectangle").set("start", start).set("end", rounded(start + within(0.03, 0.4), 3));
      break;
    case 5:
      keys.name("type", "triangle").set("start", start).set("end", rounded(start + within(0.03, 0.4), 3));
      break;
    default:
      keys.name("type", "polynomial").set("start", start);
      keys.set("coefficients",
               list({0.0, rounded(draw.normal() / t_end, 2), rounded(draw.normal() / t_end, 2)}));
  }
  return load.set("history", keys.braced());
}

}  // namespace signorini::differential
