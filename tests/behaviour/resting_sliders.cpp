// A block that rests on rigid feet and on sliders that stick rigidly, which hold the same motion: its forces are those of
// least norm.
//
//   sum (n_i N_i + t_i T_i) + sum s_j T_j = P(t),  and the moments       min sum (N_i^2 + T_i^2) + sum T_j^2
//   |T_i| <= -f_i N_i   feet,      |T_j| <= f_j q_j(t)   sliders
//
// The quadratic program is solved here by trying all faces of the sets; no code is shared with the program.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "behaviour/scene_parts.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::resting_sliders {
namespace {

constexpr double g = 9.81;
using Eigen::Vector2d;

/// A foot with a unit normal, or a slider, whose tangent is the normal turned clockwise.
struct Support {
  Vector2d place, normal;
  double fs = 0.0, fk = 0.0;
  bool slider = false;
  double q = 0.0, rate = 0.0;  // of a slider: normal force q + rate t

  [[nodiscard]] Vector2d tangent() const { return {normal[1], -normal[0]}; }
  [[nodiscard]] double limit(double t) const { return fs * (q + rate * t); }
};

struct Block {
  std::vector<Support> supports;
  Vector2d centre, top, rate;  // P = rate t at `top`
  double mass = 1.0, inertia = 0.2;
};

struct View {
  double angle = 0.0;
  bool reversed = false;  // order of the contacts
};

Vector2d seen(const Vector2d& x, const View& view) {
  const double c = std::cos(view.angle), s = std::sin(view.angle);
  return {c * x[0] - s * x[1], s * x[0] + c * x[1]};
}
double cross(const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

/// Equilibrium at time t: a x = r. x: N and T of each foot, T of each slider; place: the first entry of each support.
struct Equilibrium {
  Eigen::MatrixXd a;
  Eigen::VectorXd r;
  std::vector<Eigen::Index> place;
};

Equilibrium equilibrium(const Block& b, double t) {
  Equilibrium e;
  Eigen::Index size = 0;
  for (const Support& s : b.supports) {
    e.place.push_back(size);
    size += s.slider ? 1 : 2;
  }
  e.a.resize(3, size);
  for (std::size_t i = 0; i < b.supports.size(); ++i) {
    const Support& s = b.supports[i];
    const Vector2d arm = s.place - b.centre, k = s.tangent();
    if (!s.slider) e.a.col(e.place[i]) << s.normal, cross(arm, s.normal);
    e.a.col(e.place[i] + (s.slider ? 0 : 1)) << k, cross(arm, k);
  }
  const Vector2d push = b.rate * t;
  e.r.resize(3);
  e.r << push[0], push[1] - b.mass * g, cross(b.top - b.centre, push);
  return e;
}

/// The forces of least norm; nullopt: no forces within the sets hold the block. A face of a foot: no force, an edge or the whole
/// cone; of a slider: either limit or between them.
std::optional<Eigen::VectorXd> least(const Block& b, double t) {
  const Equilibrium e = equilibrium(b, t);
  const Eigen::Index size = e.a.cols();
  std::optional<Eigen::VectorXd> best;
  for (int code = 0, codes = 1 << (2 * static_cast<int>(b.supports.size())); code < codes; ++code) {
    Eigen::MatrixXd span(size, 0);
    Eigen::VectorXd fixed = Eigen::VectorXd::Zero(size);
    const auto add = [&](Eigen::Index at, double x, double y, bool two) {
      span.conservativeResize(Eigen::NoChange, span.cols() + 1);
      span.rightCols(1).setZero();
      span(at, span.cols() - 1) = x;
      if (two) span(at + 1, span.cols() - 1) = y;
    };
    bool valid = true;
    for (std::size_t i = 0; i < b.supports.size(); ++i) {
      const int face = (code >> (2 * i)) % 4;
      const Support& s = b.supports[i];
      const double edge = std::hypot(1.0, s.fs);
      if (s.slider) {
        valid = valid && face != 0;
        if (face == 3) add(e.place[i], 1.0, 0.0, false);
        if (face == 1 || face == 2) fixed[e.place[i]] = (face == 1 ? 1.0 : -1.0) * s.limit(t);
      } else if (face == 3) {
        add(e.place[i], 1.0, 0.0, true);
        add(e.place[i], 0.0, 1.0, true);
      } else if (face > 0) {
        add(e.place[i], -1.0 / edge, (face == 1 ? s.fs : -s.fs) / edge, true);
      }
    }
    if (!valid) continue;
    Eigen::VectorXd x = fixed;
    if (span.cols() > 0) x += span * (e.a * span).completeOrthogonalDecomposition().solve(e.r - e.a * fixed);
    const double size_of_forces = std::max(e.r.norm(), x.norm());
    if ((e.a * x - e.r).norm() > 1e-11 * size_of_forces) continue;
    bool inside = true;
    for (std::size_t i = 0; i < b.supports.size(); ++i) {
      const Support& s = b.supports[i];
      const Eigen::Index at = e.place[i];
      const double T = x[s.slider ? at : at + 1], limit = s.slider ? s.limit(t) : -s.fs * x[at];
      inside = inside && std::abs(T) <= limit + 1e-11 * size_of_forces;
      if (!s.slider) inside = inside && x[at] <= 1e-11 * size_of_forces;
    }
    if (inside && (!best || x.norm() < best->norm())) best = x;
  }
  return best;
}

/// The first time at which the block can no longer rest, at most `end`.
double last_rest(const Block& b, double end) {
  const int parts = 16;
  double rests = 0.0, moves = end;
  bool ends = false;
  for (int i = 1; i <= parts && !ends; ++i) {
    const double t = end * i / parts;
    ends = !least(b, t);
    (ends ? moves : rests) = t;
  }
  for (int i = 0; ends && i < 26; ++i) {
    const double middle = 0.5 * (rests + moves);
    (least(b, middle) ? rests : moves) = middle;
  }
  return rests;
}

std::string pair(const Vector2d& x) { return fmt::format("[{:.17g}, {:.17g}]", x[0], x[1]); }

std::string contact_text(const Support& s, std::size_t i, const View& view) {
  const std::string friction =
      fmt::format("friction = {{ static = {:.17g}, kinetic = {:.17g} }}\n", s.fs, s.fk);
  const std::string head = fmt::format("[[contacts]]\nname = \"c{0}\"\nnode = \"F{0}\"\n", i) + friction;
  if (!s.slider) return head + "law = \"rigid\"\nnormal = " + pair(seen(s.normal, view)) + "\n";
  return head + "law = \"slider\"\ntangent = " + pair(seen(s.tangent(), view)) +
         fmt::format(
             "\nnormal_force = {{ type = \"polynomial\", coefficients = [{:.17g}, {:.17g}], start = 0.0 }}\n",
             s.q, s.rate);
}

std::string scene_text(const Block& b, const View& view) {
  std::string text = parts::head + "gravity = " + pair(seen(Vector2d(0.0, -g), view)) +
                     "\n[run]\nt_end = 1.0\noutput_dt = 0.1\n[nodes]\nT = " + pair(seen(b.top, view)) + "\n";
  std::string names = "\"T\"", contacts;
  for (std::size_t i = 0; i < b.supports.size(); ++i) {
    text += fmt::format("F{} = {}\n", i, pair(seen(b.supports[i].place, view)));
    names += fmt::format(", \"F{}\"", i);
    const std::string one = contact_text(b.supports[i], i, view);
    contacts = view.reversed ? one + contacts : contacts + one;
  }
  text +=
      fmt::format("[[rigid]]\nname = \"B\"\ncentre = {}\nnodes = [{}]\nmass = {:.17g}\ninertia = {:.17g}\n",
                  pair(seen(b.centre, view)), names, b.mass, b.inertia);
  return text + contacts +
         fmt::format(
             "[[loads]]\nnode = \"T\"\ndirection = {}\namplitude = {:.17g}\nhistory = {{ type = "
             "\"polynomial\", coefficients = [0.0, 1.0], start = 0.0 }}\n",
             pair(seen(b.rate, view)), b.rate.norm());
}

void check_case(const Block& b, const View& view, const std::string& engine, double end) {
  const std::string text = scene_text(b, view);
  CAPTURE(text);
  CAPTURE(engine);
  CAPTURE(end);
  const Scene read = parse_scene(text, "test.toml",
                                 {{"run.engine", engine},
                                  {"run.certify", "false"},
                                  {"run.dt", "1e-3"},
                                  {"run.t_end", fmt::format("{:.17g}", end)}});
  const Result result = simulate(build_model(read), read.run);
  CHECK(result.report.outcome.reason == "");
  CHECK(result.report.law_checks.violations.empty());
  double worst = 0.0, at = 0.0;
  int rows = 0;
  for (const Result::Row& row : result.rows) {
    if (row.t > end) break;
    ++rows;
    const Eigen::VectorXd x = *least(b, row.t);
    for (std::size_t i = 0; i < b.supports.size(); ++i) {
      const std::size_t k = view.reversed ? b.supports.size() - 1 - i : i;
      const Eigen::Index place = equilibrium(b, row.t).place[k];
      const auto& found = row.contacts[i];
      const double off = b.supports[k].slider ? std::abs(found.T - x[place])
                                              : std::hypot(found.N - x[place], found.T - x[place + 1]);
      if (off / x.norm() > worst) worst = off / x.norm(), at = row.t;
    }
  }
  CAPTURE(at);
  CHECK(worst < 1e-9);
  CHECK(rows > 1);
}

Block random_block(std::mt19937_64& random, std::size_t feet, std::size_t sliders) {
  std::uniform_real_distribution<double> part(0.0, 1.0);
  Block b;
  const double width = 0.5 + 0.6 * part(random);
  b.mass = 0.5 + 1.5 * part(random);
  b.inertia = 0.2 * b.mass;
  for (std::size_t i = 0; i < feet + sliders; ++i) {
    Support s;
    s.slider = i >= feet;
    const double angle = (s.slider ? 3.0 : 1.0) * (part(random) - 0.5);
    s.normal = {std::sin(angle), std::cos(angle)};
    const double at = feet > 1 && !s.slider ? static_cast<double>(i) / static_cast<double>(feet - 1) : 0.5;
    s.place = {width * (at + 0.3 * part(random) - 0.15), 0.5 * part(random) - 0.25};
    s.fk = 0.1 + 0.5 * part(random);
    s.fs = part(random) < 0.5 ? s.fk : s.fk * (1.0 + part(random));
    s.q = b.mass * g * (0.05 + 0.5 * part(random));
    s.rate = part(random) < 0.5 ? 0.0 : s.q * (part(random) - 0.4);
    b.supports.push_back(s);
  }
  b.centre = {width * (0.3 + 0.4 * part(random)), 0.5 + 0.4 * part(random)};
  b.top = {width * part(random), b.centre[1] + part(random)};
  b.rate = Vector2d(part(random) < 0.5 ? 1.0 : -1.0, 0.6 * part(random) - 0.3) * (6.0 + 12.0 * part(random));
  return b;
}

/// A mass of 1 kg on a line: contacts as text, and a load P(t) to the right.
Scene line_scene(const std::string& contacts, const std::string& history, const std::string& engine,
                 double angle, double t_end) {
  const Vector2d x = seen({1.0, 0.0}, {angle}), y = seen({0.0, 1.0}, {angle});
  std::string text = parts::head + "[run]\nt_end = " + fmt::format("{:.17g}", t_end) +
                     "\noutput_dt = 0.01\n[nodes]\nm = [0.0, 0.0]\n[[masses]]\nnode = \"m\"\nmass = 1.0\n"
                     "[[springs]]\nnode = \"m\"\ndirection = " +
                     pair(y) + "\nstiffness = 100.0\n" + contacts +
                     "[[loads]]\nnode = \"m\"\ndirection = " + pair(x) +
                     "\namplitude = 1.0\nhistory = " + history + "\n";
  for (const auto& [name, direction] :
       {std::pair{"$x", x}, std::pair{"$-x", Vector2d(-x)}, std::pair{"$y", y}})
    for (std::size_t at; (at = text.find(name)) != std::string::npos;)
      text.replace(at, std::string(name).size(), pair(direction));
  return parse_scene(text, "test.toml",
                     {{"run.engine", engine}, {"run.certify", "false"}, {"run.dt", "1e-3"}});
}

const std::string dry =
    "[[contacts]]\nname = \"dry\"\nnode = \"m\"\nlaw = \"slider\"\ntangent = $x\nnormal_force = "
    "10.0\nfriction = "
    "0.3\n";
const std::string stop =
    "[[contacts]]\nname = \"stop\"\nnode = \"m\"\nlaw = \"rigid\"\nnormal = $-x\ngap = 0.1\nrestitution = "
    "0.0\n";

}  // namespace

TEST_SUITE_BEGIN("behaviour/resting_sliders");

TEST_CASE("a mass with dry friction comes to rest at a rigid stop") {
  for (const std::string engine : {"exact", "ida", "newmark"})
    for (const double angle : {0.0, 0.7})
      for (const bool stop_first : {false, true}) {
        CAPTURE(engine);
        CAPTURE(angle);
        const Scene scene =
            line_scene(stop_first ? stop + dry : dry + stop,
                       "{ type = \"polynomial\", coefficients = [10.0], start = 0.0 }", engine, angle, 2.0);
        const Result result = simulate(build_model(scene), scene.run);
        CHECK(result.report.outcome.reason == "");
        CHECK(result.report.law_checks.violations.empty());
        const std::size_t of_stop = stop_first ? 0 : 1;
        double t = -1.0;
        for (const Event& e : result.events)
          if (e.contact == static_cast<int>(of_stop) && t < 0.0) t = e.t;
        CHECK(t == doctest::Approx(std::sqrt(0.2 / 7.0)).epsilon(engine == "newmark" ? 1e-3 : 1e-7));
        const Result::Row& last = result.rows.back();
        CHECK(last.contacts[of_stop].N == doctest::Approx(-7.0));
        CHECK(std::abs(last.contacts[1 - of_stop].T) == doctest::Approx(3.0));
        CHECK(last.u.norm() == doctest::Approx(0.1));
        CHECK(last.v.norm() <= 1e-12);
      }
}

TEST_CASE("dry friction at a stop is released, turns and slips back as the load falls") {
  // P = 10 - 5 t from rest at the stop, g0 = 0. N + T = P, equal shares while T <= 3: T = 3 until P = 6 (t = 0.8), zero at t = 2;
  // then the stop opens and T = P until P = -3 (t = 2.6), where the mass slips back.
  const std::string touching = stop.substr(0, stop.find("gap")) + stop.substr(stop.find("restitution"));
  for (const std::string engine : {"exact", "ida", "newmark"}) {
    CAPTURE(engine);
    const Scene scene =
        line_scene(dry + touching, "{ type = \"polynomial\", coefficients = [10.0, -5.0], start = 0.0 }",
                   engine, 0.4, 3.0);
    const Result result = simulate(build_model(scene), scene.run);
    CHECK(result.report.outcome.reason == "");
    for (const Result::Row& row : result.rows) {
      CAPTURE(row.t);
      const double P = 10.0 - 5.0 * row.t;
      if (row.t > 2.6) break;
      const double T = P > 6.0 ? 3.0 : P > 0.0 ? 0.5 * P : P;
      CHECK(std::abs(row.contacts[0].T - T) <= 1e-9 * 10.0);
      CHECK(std::abs(row.contacts[1].N + P - T) <= 1e-9 * 10.0);
    }
    double slips = 0.0;
    for (const Event& e : result.events)
      if (e.contact == 0 && e.type == EventType::slip && e.t > 2.1 && slips == 0.0) slips = e.t;
    CHECK(slips == doctest::Approx(2.6).epsilon(engine == "newmark" ? 2e-3 : 1e-8));
  }
}

TEST_CASE("sliders and a wall share a load that begins at zero, returns through zero and turns") {
  // q = 3 and 1 bear at most 3 and 1 N. Pressed to the wall by F: N = T1 = T2 = F/3 up to F = 3, then T2 = 1 and N = T1 up
  // to F = 7, then T1 = 3. Pulled off: T1 = T2 = F/2 up to -2, then T2 = -1.
  const std::string wall = "[[contacts]]\nname = \"wall\"\nnode = \"m\"\nlaw = \"rigid\"\nnormal = $-x\n";
  const auto slider = [](const std::string& name, const std::string& q) {
    return "[[contacts]]\nname = \"" + name +
           "\"\nnode = \"m\"\nlaw = \"slider\"\ntangent = $x\nnormal_force = " + q + "\nfriction = 1.0\n";
  };
  const std::string history =
      "{ type = \"table\", times = [0.0, 1.0, 3.0, 4.0], values = [0.0, 10.0, -3.5, -3.5] }";
  for (const bool walled : {true, false})
    for (const std::string engine : {"exact", "ida", "newmark"}) {
      CAPTURE(engine);
      CAPTURE(walled);
      const double share = walled ? 1.0 : 0.35;  // without the wall the sliders bear at most 4 N
      const Scene scene =
          line_scene(slider("s1", "3.0") + slider("s2", "1.0") + (walled ? wall : ""),
                     walled ? history
                            : "{ type = \"table\", times = [0.0, 1.0, 3.0, 4.0], values = [0.0, "
                              "3.5, -1.225, -1.225] }",
                     engine, 0.4, 4.0);
      const Result result = simulate(build_model(scene), scene.run);
      CHECK(result.report.outcome.reason == "");
      for (const Result::Row& row : result.rows) {
        CAPTURE(row.t);
        const double t = row.t;
        const double F = share * (t < 1.0 ? 10.0 * t : t < 3.0 ? 10.0 - 6.75 * (t - 1.0) : -3.5);
        double N = 0.0, T1 = 0.0, T2 = 0.0;
        if (walled && F > 0.0) {
          T2 = std::min(1.0, F / 3.0);
          T1 = std::min(3.0, 0.5 * (F - T2));
          N = F - T1 - T2;
        } else {
          T2 = std::clamp(0.5 * F, -1.0, 1.0);
          T1 = F - T2;
        }
        CHECK(std::abs(row.contacts[0].T - T1) <= 1e-8);
        CHECK(std::abs(row.contacts[1].T - T2) <= 1e-8);
        if (walled) CHECK(std::abs(row.contacts[2].N + N) <= 1e-8);
      }
    }
}

TEST_CASE("forces of random blocks at rest on feet and sliders have the least norm, turned, in any order") {
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (int i = 0, tried = 0; i < 6 && tried < 200; ++tried) {
    CAPTURE(tried);
    const Block b = random_block(random, 2, 1);
    if (!least(b, 0.0)) continue;
    const double end = last_rest(b, 1.0) - 1e-6;
    if (end < 0.02) continue;
    ++i;
    check_case(b, {}, "exact", end);
    check_case(b, {6.0 * part(random), true}, i % 2 == 0 ? "exact" : "ida", end);
    check_case(b, {6.0 * part(random), i % 3 == 0}, i % 4 == 0 ? "newmark" : "exact", end);
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::resting_sliders
