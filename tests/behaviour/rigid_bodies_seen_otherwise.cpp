// Rigid bodies as matrices made by hand, turned, mirrored, permuted, in other units, in halves, reduced: the same motion.
//
//   M = sum T^T m T,  K = sum k (T^T d)(T^T d)^T,   rows of T: (1, 0, -(y - y_c)), (0, 1, x - x_c)
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "behaviour/rates.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::bodies_otherwise {
namespace {

struct Place {
  double x, y;
};

/// What a random scene of two bodies consists of, in N, kg, m, s.
struct Drawn {
  struct Body {
    Place centre;
    double mass, inertia;
    std::vector<Place> nodes;
  };
  struct Link {  // from a node of a body along d, to the ground or a node of the other
    int body, node, other;
    Place d;
    double stiffness, damping;
  };
  struct Touch {
    int body, node;
    Place n;
    double gap, friction, restitution;
    bool rigid;
  };
  struct Push {
    int body, node;
    Place d;
    double amplitude, omega;
  };
  std::vector<Body> bodies;
  std::vector<Link> links;
  std::vector<Touch> touches;
  std::vector<Push> pushes;
  double extra = 0.0;  // a point mass at node 0 of body 0
  Place gravity{0.0, -9.81};
};

Drawn draw(unsigned seed) {
  std::mt19937 random(seed);
  const auto from = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  const auto along = [&] {
    const double a = from(0.0, 2.0 * std::numbers::pi);
    return Place{std::cos(a), std::sin(a)};
  };
  Drawn s;
  for (const double x : {0.0, 3.0}) {
    Drawn::Body body{{x + from(-0.3, 0.3), from(0.5, 1.0)}, from(1.0, 3.0), from(0.2, 1.0), {}};
    for (int i = 0; i < 3; ++i) body.nodes.push_back({x + from(-1.0, 1.0), from(0.0, 2.0)});
    s.bodies.push_back(body);
  }
  for (int b = 0; b < 2; ++b)
    for (int i = 0; i < 3; ++i) s.links.push_back({b, i, -1, along(), from(100.0, 900.0), from(0.0, 2.0)});
  s.links.push_back({0, 1, 2, along(), from(100.0, 900.0), 0.5});
  for (int b = 0; b < 2; ++b) {
    s.touches.push_back({b, 0, along(), from(0.0, 0.05), 0.4, 0.0, false});
    s.touches.push_back({b, 2, along(), from(0.0, 0.05), 0.0, 0.5, true});
    s.pushes.push_back({b, 1, along(), from(10.0, 40.0), from(3.0, 12.0)});
  }
  s.extra = from(0.2, 1.0);
  return s;
}

/// Factors of forces, lengths and times; nodes in another order; the plane turned and mirrored.
struct View {
  double force = 1.0, length = 1.0, time = 1.0, angle = 0.0;
  bool mirrored = false, reversed = false;
  [[nodiscard]] Place turned(Place p) const {
    if (mirrored) p.x = -p.x;
    return {std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y};
  }
  [[nodiscard]] std::string direction(Place p) const {
    const Place q = turned(p);
    return fmt::format("[{:.17g}, {:.17g}]", q.x, q.y);
  }
  [[nodiscard]] std::string point(Place p) const { return direction({length * p.x, length * p.y}); }
};

std::string name_of(int body, int node) { return fmt::format("{}{}", body == 0 ? "a" : "b", node); }

std::string run_of(const View& v, const std::string& engine) {
  const char* units = v.length == 1.0 ? "force = \"N\", mass = \"kg\", length = \"m\", time = \"s\""
                                      : "force = \"N\", mass = \"t\", length = \"mm\", time = \"s\"";
  return fmt::format(
      "schema = 1\nunits = {{ {} }}\n[run]\nt_end = {:.17g}\nengine = \"{}\"\ncertify = false\n", units,
      2.0 * v.time, engine);
}

std::string contact_keys(const Drawn::Touch& t, std::size_t k, const View& v, const std::string& place) {
  std::string text = fmt::format("[[contacts]]\nname = \"c{}\"\n{}gap = {:.17g}\nfriction = {:.17g}\n", k,
                                 place, t.gap * v.length, t.friction);
  // The same in all views: scales of displacements, from which it follows, are others on matrices.
  if (t.rigid)
    return text + fmt::format("law = \"rigid\"\nrestitution = {}\ncapture_velocity = {:.17g}\n",
                              t.restitution, 1e-5 * v.length / v.time);
  const double k1 = v.force / v.length;
  return text +
         fmt::format("law = \"compliant\"\nnormal_stiffness = {:.17g}\ntangential_stiffness = {:.17g}\n",
                     2e4 * k1, 1e4 * k1);
}

std::string history_text(const Drawn::Push& p, const View& v) {
  return fmt::format("history = {{ type = \"harmonic\", omega = {:.17g}, start = 0.0 }}\n", p.omega / v.time);
}

std::string as_bodies(const Drawn& s, const View& v = {}, const std::string& engine = "exact") {
  const double mass = v.force * v.time * v.time / v.length, inertia = mass * v.length * v.length;
  const Place g{s.gravity.x * v.length / (v.time * v.time), s.gravity.y * v.length / (v.time * v.time)};
  std::string text = run_of(v, engine);
  text.insert(text.find("[run]"), "gravity = " + v.direction(g) + "\n");
  std::vector<std::string> nodes;
  for (int b = 0; b < 2; ++b)
    for (int i = 0; i < 3; ++i)
      nodes.push_back(name_of(b, i) + " = " + v.point(s.bodies[std::size_t(b)].nodes[std::size_t(i)]) + "\n");
  if (v.reversed) std::reverse(nodes.begin(), nodes.end());
  text += "[nodes]\n";
  for (const std::string& node : nodes) text += node;
  for (int b = 0; b < 2; ++b) {
    const Drawn::Body& body = s.bodies[std::size_t(b)];
    text += fmt::format(
        "[[rigid]]\nname = \"{}\"\ncentre = {}\nnodes = [\"{}0..{}2\"]\nmass = {:.17g}\ninertia = "
        "{:.17g}\n",
        b == 0 ? "A" : "B", v.point(body.centre), b == 0 ? "a" : "b", b == 0 ? "a" : "b", body.mass * mass,
        body.inertia * inertia);
  }
  text += fmt::format("[[masses]]\nnode = \"a0\"\nmass = {:.17g}\n", s.extra * mass);
  for (const Drawn::Link& l : s.links) {
    text += fmt::format("[[springs]]\nnode = \"{}\"\n", name_of(l.body, l.node));
    if (l.other >= 0) text += fmt::format("against = \"{}\"\n", name_of(1, l.other));
    text += fmt::format("direction = {}\nstiffness = {:.17g}\ndamping = {:.17g}\n", v.direction(l.d),
                        l.stiffness * v.force / v.length, l.damping * v.force * v.time / v.length);
  }
  for (std::size_t k = 0; k < s.touches.size(); ++k)
    text +=
        contact_keys(s.touches[k], k, v,
                     fmt::format("node = \"{}\"\nnormal = {}\n",
                                 name_of(s.touches[k].body, s.touches[k].node), v.direction(s.touches[k].n)));
  for (const Drawn::Push& p : s.pushes)
    text += fmt::format("[[loads]]\nnode = \"{}\"\ndirection = {}\namplitude = {:.17g}\n",
                        name_of(p.body, p.node), v.direction(p.d), p.amplitude * v.force) +
            history_text(p, v);
  return text;
}

using Row = Eigen::Matrix<double, 1, 6>;

/// d . u of a node of a body, on (x, y, rz) of both centres.
Row row_of(const Drawn& s, int body, int node, Place d) {
  const Drawn::Body& b = s.bodies[std::size_t(body)];
  const Place p = b.nodes[std::size_t(node)];
  Row row = Row::Zero();
  row[3 * body] = d.x;
  row[3 * body + 1] = d.y;
  row[3 * body + 2] = -d.x * (p.y - b.centre.y) + d.y * (p.x - b.centre.x);
  return row;
}

std::string as_table(const Row& row) {
  std::string text = "{ ";
  for (int i = 0; i < 6; ++i) text += fmt::format("{}q{} = {:.17g}", i == 0 ? "" : ", ", i, row[i]);
  return text + " }";
}

std::string as_rows(const Eigen::Matrix<double, 6, 6>& a) {
  std::string text = "[";
  for (int i = 0; i < 6; ++i) {
    text += i == 0 ? "[" : ", [";
    for (int j = 0; j < 6; ++j) text += fmt::format("{}{:.17g}", j == 0 ? "" : ", ", a(i, j));
    text += "]";
  }
  return text + "]";
}

std::string as_matrices(const Drawn& s) {
  Eigen::Matrix<double, 6, 6> m = Eigen::Matrix<double, 6, 6>::Zero(), c = m, k = m;
  Row weight = Row::Zero();
  for (int b = 0; b < 2; ++b) {
    const Drawn::Body& body = s.bodies[std::size_t(b)];
    m.diagonal().segment<3>(3 * b) << body.mass, body.mass, body.inertia;
    weight[3 * b + 1] += body.mass * s.gravity.y;
  }
  const Row ex = row_of(s, 0, 0, {1.0, 0.0}), ey = row_of(s, 0, 0, {0.0, 1.0});
  m += s.extra * (ex.transpose() * ex + ey.transpose() * ey);
  weight += s.extra * s.gravity.y * ey;
  for (const Drawn::Link& l : s.links) {
    Row a = row_of(s, l.body, l.node, l.d);
    if (l.other >= 0) a -= row_of(s, 1, l.other, l.d);
    k += l.stiffness * a.transpose() * a;
    c += l.damping * a.transpose() * a;
  }
  const auto symmetric = [](const Eigen::Matrix<double, 6, 6>& x) {
    return Eigen::Matrix<double, 6, 6>(0.5 * (x + x.transpose()));
  };
  std::string text =
      run_of({}, "exact") +
      "[matrices]\ndofs = [\"q0\", \"q1\", \"q2\", \"q3\", \"q4\", \"q5\"]\nmass = " + as_rows(symmetric(m)) +
      "\ndamping = " + as_rows(symmetric(c)) + "\nstiffness = " + as_rows(symmetric(k)) + "\n";
  for (std::size_t i = 0; i < s.touches.size(); ++i) {
    const Drawn::Touch& t = s.touches[i];
    std::string place = "normal = " + as_table(row_of(s, t.body, t.node, t.n)) + "\n";
    if (t.friction > 0.0) place += "tangent = " + as_table(row_of(s, t.body, t.node, {t.n.y, -t.n.x})) + "\n";
    text += contact_keys(t, i, {}, place);
  }
  text += "[[loads]]\ndirection = " + as_table(weight) + "\namplitude = 1.0\n";
  for (const Drawn::Push& p : s.pushes)
    text += fmt::format("[[loads]]\ndirection = {}\namplitude = {:.17g}\n",
                        as_table(row_of(s, p.body, p.node, p.d)), p.amplitude) +
            history_text(p, {});
  return text;
}

Result run_scene(const std::string& text, const std::vector<Override>& changes = {}) {
  const Scene scene = parse_scene(text, "test.toml", changes);
  Result result = simulate(build_model(scene), scene.run);
  CHECK(result.report.outcome.reason == "");
  CHECK(result.report.law_checks.violations.empty());
  return result;
}

/// The same changes of state at the same times; signs of slip turn with the tangents of a mirrored plane.
void check_same(const Result& a, const Result& b, double time, double tolerance, bool mirrored = false) {
  REQUIRE(a.events.size() == b.events.size());
  for (std::size_t i = 0; i < a.events.size(); ++i) {
    CHECK(std::abs(a.events[i].t * time - b.events[i].t) < tolerance * time);
    CHECK(a.events[i].contact == b.events[i].contact);
    CHECK(a.events[i].type == b.events[i].type);
    if (!mirrored) CHECK(a.events[i].to == b.events[i].to);
  }
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/rigid_bodies_seen_otherwise");

TEST_CASE("random bodies move as their matrices, made by hand") {
  std::size_t events = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    CAPTURE(seed);
    const Drawn s = draw(seed);
    const Result bodies = run_scene(as_bodies(s)), matrices = run_scene(as_matrices(s));
    check_same(bodies, matrices, 1.0, 1e-9);
    const Model model = build_model(parse_scene(as_bodies(s), "test.toml"));
    for (std::size_t i = 0; i < model.columns.size(); ++i)
      if (const std::string& name = model.columns[i].name; name == "A.ux" || name == "B.rz")
        CHECK(bodies.rows.back().u[model.columns[i].dof] ==
              doctest::Approx(matrices.rows.back().u[name == "A.ux" ? 0 : 5]).epsilon(1e-8));
    events += bodies.events.size();
  }
  CHECK(events > 100);
}

TEST_CASE("turned, mirrored, permuted, in other units: the same events") {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    CAPTURE(seed);
    const Drawn s = draw(seed);
    const Result plain = run_scene(as_bodies(s));
    View view;
    view.angle = 0.7391;
    check_same(plain, run_scene(as_bodies(s, view)), 1.0, 1e-9);
    view.mirrored = true;
    check_same(plain, run_scene(as_bodies(s, view)), 1.0, 1e-9, true);
    View permuted;
    permuted.reversed = true;
    check_same(plain, run_scene(as_bodies(s, permuted)), 1.0, 1e-9);
    View small;  // N, t, mm: force 1, length 1000
    small.length = 1000.0;
    check_same(plain, run_scene(as_bodies(s, small)), 1.0, 1e-9);
    check_same(plain, run_scene(as_bodies(s, {}, "ida")), 1.0, 1e-5);
  }
}

TEST_CASE("the second half of a run, and a reduced model with all modes, move alike") {
  const Drawn s = draw(3);
  const Result plain = run_scene(as_bodies(s));
  const Result reduced = run_scene(as_bodies(s) + "[reduction]\ncutoff_omega = 1e5\n");
  check_same(plain, reduced, 1.0, 1e-9);
  REQUIRE(plain.rows.back().u.size() == reduced.rows.back().u.size());
  CHECK((plain.rows.back().u - reduced.rows.back().u).norm() < 1e-9 * plain.rows.back().u.norm());

  Scene scene = parse_scene(as_bodies(s), "test.toml", {{"run.t_end", "1.0"}});
  const Model model = build_model(scene);
  Scene rest = parse_scene(as_bodies(s), "test.toml", {{"run.t_end", "1.0"}});
  for (LoadSpec& load : rest.loads) load.history.shift = -1.0;
  rest.initial.saved = last_state(model, simulate(model, scene.run));
  const Result second = simulate(build_model(rest), rest.run);
  std::vector<Event> later;
  for (const Event& event : plain.events)
    if (event.t > 1.0) later.push_back(event);
  REQUIRE(second.events.size() == later.size());
  for (std::size_t i = 0; i < later.size(); ++i)
    CHECK(std::abs(second.events[i].t + 1.0 - later[i].t) < 1e-10);
}

TEST_CASE("events move with mass and inertia of a body as differences say") {
  const Drawn s = draw(5);
  const std::string text = as_bodies(s);
  for (const char* key : {"rigid.A.mass", "rigid.A.inertia"}) {
    CAPTURE(key);
    const double value = key[8] == 'm' ? s.bodies[0].mass : s.bodies[0].inertia, h = 1e-5 * value;
    const auto times = [&](double p) { return run_scene(text, {{key, fmt::format("{:.17g}", p)}}); };
    const Result up = times(value + h), down = times(value - h);
    const Sensitivities all = rates_of(text, {key});
    REQUIRE(all.events.size() == up.events.size());
    int known = 0;
    for (std::size_t i = 0; i < up.events.size() && all.events[i].t < all.parameters[0].until; ++i) {
      const double difference = (up.events[i].t - down.events[i].t) / (2.0 * h);
      CHECK(all.event_rates[i][0].t == doctest::Approx(difference).epsilon(1e-4).scale(1e-2));
      ++known;
    }
    CAPTURE(all.parameters[0].reason);
    CHECK(known > 10);
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::bodies_otherwise
