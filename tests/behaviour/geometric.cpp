// run.geometric: members under axial forces, against closed forms of buckling, of bending under load and of frequencies.
//
//   (K + lambda K_g) x = 0,   omega^2 M x = (K + K_g) x,   (K + K_g) u = P
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "behaviour/outputs.hpp"
#include "behaviour/rates.hpp"
#include "behaviour/scene_parts.hpp"
#include "model/modes/frequencies.hpp"

namespace signorini::tests::geometric {
namespace {

using namespace parts;

constexpr double pi = std::numbers::pi;

Model built(const std::string& text, const std::vector<Override>& changes = {}) {
  return build_model(parse_scene(text, "test.toml", changes));
}

double first_factor(const std::string& text) {
  const Model model = built(text);
  REQUIRE(model.geometric);
  REQUIRE(!model.geometric->load_factors.empty());
  return model.geometric->load_factors.front();
}

/// With P-delta, from a static start.
std::string stood(bool geometric = true) {
  return head + fmt::format(
                    "[run]\nt_end = 1.0\noutput_dt = 0.5\nengine = \"exact\"\ninitial = "
                    "\"static\"\ngeometric = {}\n",
                    geometric);
}

std::string force(const std::string& node, double x, double y) {
  const double size = std::hypot(x, y);
  if (size == 0.0) return "";
  return fmt::format("[[loads]]\nnode = \"{}\"\ndirection = [{:.17g}, {:.17g}]\namplitude = {:.17g}\n", node,
                     x / size, y / size, size);
}

/// Along an axis that is turned.
struct Turned {
  double c = 1.0, s = 0.0;
  explicit Turned(double angle) : c(std::cos(angle)), s(std::sin(angle)) {}
  [[nodiscard]] std::string vector(double x, double y) const {
    return fmt::format("[{:.17g}, {:.17g}]", c * x - s * y, s * x + c * y);
  }
  [[nodiscard]] std::string force(const std::string& node, double x, double y) const {
    return geometric::force(node, c * x - s * y, s * x + c * y);
  }
};

constexpr double length = 3.0, EI = 7.0, EA = 5e5, rho = 0.3;

/// From A up to B, in n elements, under P downwards at B.
std::string column(const std::string& supports, int n, double P, bool geometric = true) {
  return stood(geometric) + nodes({{"A", 0.0, 0.0}, {"B", 0.0, length}}) + section(EA, EI, rho) +
         member("A, B", fmt::format("elements = {}\n", n)) + supports + force("B", 0.0, -P);
}

std::string bars(double mass) {
  return fmt::format("[sections.s]\nEA = {}\nmass_per_length = {}\n", EA, mass);
}

/// log2 of how errors fall from each number of elements to its double.
std::vector<double> orders(const std::vector<double>& errors) {
  std::vector<double> result;
  for (std::size_t i = 1; i < errors.size(); ++i) result.push_back(std::log2(errors[i - 1] / errors[i]));
  return result;
}

struct Ends {
  const char* name;
  std::string supports;
  double free_length;  ///< over the length
};

std::vector<Ends> four_ends() {
  return {{"free", fixed("A", "ux, uy, rz"), 2.0},
          {"pinned", fixed("A", "ux, uy") + fixed("B", "ux"), 1.0},
          {"propped", fixed("A", "ux, uy, rz") + fixed("B", "ux"), pi / 4.493409457909064},
          {"clamped", fixed("A", "ux, uy, rz") + fixed("B", "ux, rz"), 0.5}};
}

double euler(double free_length) { return pi * pi * EI / std::pow(free_length * length, 2); }

}  // namespace

TEST_SUITE_BEGIN("behaviour/geometric");

TEST_CASE("Euler's loads of four end conditions, at order 4") {
  for (const Ends& ends : four_ends()) {
    CAPTURE(std::string(ends.name));
    const double P = 0.3 * euler(ends.free_length);
    std::vector<double> errors;
    for (const int n : {4, 8, 16, 32})
      errors.push_back(first_factor(column(ends.supports, n, P)) * P / euler(ends.free_length) - 1.0);
    for (const double order : orders(errors)) {
      CHECK(order > 3.85);
      CHECK(order < 4.1);
    }
    CHECK(errors.back() > 0.0);
    CHECK(errors.back() < 3e-6);
  }
}

TEST_CASE("loads far below the first factor have it, too, and those close to it") {
  const double whole = first_factor(column(fixed("A", "ux, uy, rz"), 8, 0.5 * euler(2.0))) * 0.5;
  for (const double part : {1e-7, 1e-3, 0.999})
    CHECK(first_factor(column(fixed("A", "ux, uy, rz"), 8, part * euler(2.0))) * part ==
          doctest::Approx(whole).epsilon(1e-7));
}

TEST_CASE("what lies beside a column and is free, or has no stiffness of its own, leaves its factor alone") {
  // Common null motions of K and K_g: three of each free frame, which are not along axes.
  const double P = 0.3 * euler(2.0);
  const std::string alone = column(fixed("A", "ux, uy, rz"), 8, P);
  std::string beside = alone;
  beside.insert(beside.find("[sections"),
                "C = [1.1, 0.3]\nD = [3.4, 2.7]\nE = [2.2, 4.9]\nF = [5.0, 0.1]\nG = [5.9, 1.3]\n");
  beside += member("C, D, E") + member("F, G", "elements = 3\n");
  CHECK(first_factor(beside) == doctest::Approx(first_factor(alone)).epsilon(1e-9));
}

TEST_CASE("a contact without friction holds nothing along its surface: the factor is that of the free end") {
  const double P = 0.3 * euler(2.0);
  const std::string alone = column(fixed("A", "ux, uy, rz"), 8, P);
  // It takes 1e-7 of the load.
  const std::string contact =
      "[[contacts]]\nname = \"top\"\nnode = \"B\"\nlaw = \"compliant\"\nnormal = [0.0, 1.0]\n"
      "normal_stiffness = 0.01\ntangential_stiffness = 1e3\nfriction = ";
  CHECK(first_factor(alone + contact + "0.0\n") == doctest::Approx(first_factor(alone)).epsilon(1e-6));
  CHECK(first_factor(alone + contact + "0.5\n") > 5.0 * first_factor(alone));  // as if it held
}

TEST_CASE("a column under its own weight buckles at Greenhill's length, at order 4") {
  // q L^3 / EI = 9/4 j^2, j: the first zero of the Bessel function of order -1/3
  const double critical = 2.25 * std::pow(1.866350858898855, 2) * EI / std::pow(length, 3);
  for (const double part : {0.4, 0.9}) {
    std::vector<double> errors;
    for (const int n : {4, 8, 16, 32}) {
      std::string text = stood() + nodes({{"A", 0.0, 0.0}, {"B", 0.0, length}}) + section(EA, EI, rho) +
                         member("A, B", fmt::format("elements = {}\n", n)) + fixed("A", "ux, uy, rz");
      text.insert(text.find("[run]"), fmt::format("gravity = [0.0, {:.17g}]\n", -part * critical / rho));
      errors.push_back(first_factor(text) * part - 1.0);
    }
    for (const double order : orders(errors)) CHECK(order == doctest::Approx(4.0).epsilon(0.05));
  }
}

TEST_CASE("a load spread along a column, as a column's weight: the same factor, in either axes") {
  const double critical = 2.25 * std::pow(1.866350858898855, 2) * EI / std::pow(length, 3), part = 0.4;
  std::string weight = stood() + nodes({{"A", 0.0, 0.0}, {"B", 0.0, length}}) + section(EA, EI, rho) +
                       member("A, B", "elements = 8\n") + fixed("A", "ux, uy, rz");
  const std::string spread = weight;
  weight.insert(weight.find("[run]"), fmt::format("gravity = [0.0, {:.17g}]\n", -part * critical / rho));
  const auto load = [&](const std::string& along) {
    return fmt::format("[[loads]]\nnodes = [\"A\", \"B\"]\n{}\ndistributed = {:.17g}\n", along,
                       part * critical);
  };
  CHECK(first_factor(spread + load("axes = \"global\"\ndirection = [0.0, -1.0]")) ==
        doctest::Approx(first_factor(weight)).epsilon(1e-10));
  CHECK(first_factor(spread + load("axes = \"member\"\ndirection = [-1.0, 0.0]")) ==
        doctest::Approx(first_factor(weight)).epsilon(1e-10));
}

TEST_CASE("the frequency of a loaded column: f0 sqrt(1 - P / P_cr), at order 4, tension too") {
  for (const double part : {0.5, 0.95, -2.0}) {
    CAPTURE(part);
    const double P = part * euler(1.0);
    const double square = std::pow(pi / length, 4) * EI / rho * (1.0 - part);
    std::vector<double> errors;
    for (const int n : {4, 8, 16, 32}) {
      const Model model = built(column(fixed("A", "ux, uy") + fixed("B", "ux"), n, P));
      errors.push_back(model.omega1 * model.omega1 / square - 1.0);
    }
    for (const double order : orders(errors)) CHECK(order == doctest::Approx(4.0).epsilon(0.05));
  }
}

TEST_CASE("damping beta K is that of the elastic stiffness") {
  const std::string text = column(fixed("A", "ux, uy, rz"), 3, 0.6 * euler(2.0)) + "[damping]\nbeta = 0.01\n";
  const Model loaded = built(text), plain = built(text, {{"run.geometric", "false"}});
  CHECK(SparseMatrix(loaded.stiffness - plain.stiffness).norm() > 0.1);
  CHECK(SparseMatrix(loaded.damping - plain.damping).norm() < 1e-13 * plain.damping.norm());
}

TEST_CASE("bars in a row on springs: all load factors, however the row is turned") {
  // k x = P / l (2 x_j - x_(j-1) - x_(j+1)):   P_j = k l / (2 - 2 cos(j pi / n))
  const double k = 11.0, l = 0.7, P = 1.3;
  constexpr int n = 6;
  for (const double angle : {0.0, 0.731, 2.2}) {
    const Turned turned(angle);
    std::string names, points = "[nodes]\n", rest;
    for (int i = 0; i <= n; ++i) {
      names += fmt::format("{}p{}", i == 0 ? "" : ", ", i);
      points += fmt::format("p{} = {}\n", i, turned.vector(i * l, 0.0));
      if (i > 0) rest += member(fmt::format("p{}, p{}", i - 1, i), "type = \"bar\"\n");
      if (i > 0 && i < n) rest += spring(fmt::format("p{}", i), turned.vector(0.0, 1.0), k);
    }
    // What holds the ends across and the first one along are springs, so that the row may be turned.
    for (const char* end : {"p0", "p6"}) rest += spring(end, turned.vector(0.0, 1.0), 1e11);
    rest += spring("p0", turned.vector(1.0, 0.0), 1e11);
    const Model model = built(stood() + points + bars(rho) + rest + turned.force("p6", -P, 0.0));
    REQUIRE(model.geometric);
    const std::vector<double>& found = model.geometric->load_factors;
    REQUIRE(found.size() == 5);
    for (int j = 1; j < n; ++j)
      CHECK(found[static_cast<std::size_t>(n - 1 - j)] ==
            doctest::Approx(k * l / (P * (2.0 - 2.0 * std::cos(j * pi / n)))).epsilon(1e-8));
  }
}

namespace {

/// Bars in a row of n, which only their tension S holds; a force pulls at the end, or each bar is cold, or all together
/// are too short.
std::string string_of(const std::string& why, int n, double l, double angle, double S, double m) {
  const double c = std::cos(angle), s = std::sin(angle);
  std::string points = "[nodes]\n", rest, names;
  for (int i = 0; i <= n; ++i) {
    points += fmt::format("p{} = [{:.17g}, {:.17g}]\n", i, i * l * c, i * l * s);
    names += fmt::format("{}p{}", i > 0 ? ", " : "", i);
    const std::string cold =
        why == "cold" ? fmt::format("thermal_expansion = 1e-5\ntemperature = {:.17g}\n", -S / (EA * 1e-5))
                      : std::string();
    if (i > 0 && why != "short") rest += member(fmt::format("p{}, p{}", i - 1, i), "type = \"bar\"\n" + cold);
    if (i > 0 && i < n) rest += point_mass(fmt::format("p{}", i), m);
  }
  if (why == "short")
    rest += member(names, fmt::format("type = \"bar\"\ninitial_strain = {:.17g}\n", -S / EA));
  rest += fixed("p0", "ux, uy");
  if (why != "pulled") return stood() + points + bars(0.0) + rest + fixed(fmt::format("p{}", n), "ux, uy");
  rest +=
      fmt::format("[[springs]]\nnode = \"p{}\"\ndirection = [{:.17g}, {:.17g}]\nstiffness = 1e9\n", n, -s, c);
  return stood() + points + bars(0.0) + rest + force(fmt::format("p{}", n), S * c, S * s);
}

}  // namespace

TEST_CASE("a string of bars: what only its tension holds, by a force, by cold and by length, at any angle") {
  const double l = 0.5, S = 3.0, m = 0.02;
  constexpr int n = 5;
  for (const char* why : {"pulled", "cold", "short"})
    for (const double angle : {0.0, std::atan2(8.0, 6.0), std::atan2(6.0, 8.0), 1.5 * pi, 4.1}) {
      CAPTURE(why);
      CAPTURE(angle);
      const Model model = built(string_of(why, n, l, angle, S, m));
      const modes::Frequencies found =
          modes::lowest_frequencies(model.mass, model.damping, model.stiffness, {}, n - 1);
      REQUIRE(found.modes.size() == n - 1);
      // The spring that guides the pulled end gives way by S / l over its 1e9.
      const double within = why == std::string("pulled") ? 1e-8 : 1e-10;
      for (int j = 1; j < n; ++j)
        CHECK(std::pow(found.modes[static_cast<std::size_t>(j - 1)].omega, 2) ==
              doctest::Approx(S / (m * l) * (2.0 - 2.0 * std::cos(j * pi / n))).epsilon(within));
      CHECK(model.geometric->load_factors.empty());  // tension alone
    }
}

TEST_CASE(
    "in tension the load factors are negative: a tie buckles under loads of the other sign, many elements "
    "alike") {
  for (const Ends& ends : four_ends()) {
    CAPTURE(std::string(ends.name));
    const double P = 0.3 * euler(ends.free_length);
    // 100 elements have more degrees of freedom than the dense solver takes.
    for (const int n : {16, 100}) {
      CAPTURE(n);
      const Model pulled = built(column(ends.supports, n, -P)), pushed = built(column(ends.supports, n, P));
      REQUIRE(pulled.geometric->load_factors.size() == 5);
      for (std::size_t i = 0; i < 5; ++i)
        CHECK(pulled.geometric->load_factors[i] ==
              doctest::Approx(-pushed.geometric->load_factors[i]).epsilon(1e-7));
      CHECK(pulled.geometric->load_factors[0] * P == doctest::Approx(-euler(ends.free_length)).epsilon(1e-4));
      for (const std::string& warning : pulled.warnings) CHECK(warning.find("unstable") == std::string::npos);
    }
  }
}

TEST_CASE("a long string of short bars, whose directions round more: it is held, and nothing drives it") {
  const double S = 3.0, m = 0.02, l = 0.01, angle = 0.7;
  constexpr int n = 300;
  std::string text = string_of("short", n, l, angle, S, m);
  const Model model = built(text);
  const modes::Frequencies found =
      modes::lowest_frequencies(model.mass, model.damping, model.stiffness, {}, 1);
  CHECK(std::pow(found.modes[0].omega, 2) ==
        doctest::Approx(S / (m * l) * (2.0 - 2.0 * std::cos(pi / n))).epsilon(1e-5));
}

TEST_CASE("a cantilever under both loads: deflection by its closed form, moments by statics") {
  const double H = 0.02, P = 0.6 * euler(2.0), u = length * std::sqrt(P / EI);
  std::vector<double> errors;
  const Turned turned(0.417);
  for (const int n : {2, 4, 8}) {
    CAPTURE(n);
    const std::string text =
        stood() + fmt::format("[nodes]\nA = [0.0, 0.0]\nB = {}\n", turned.vector(0.0, length)) +
        section(EA, EI, rho) + member("A, B", fmt::format("elements = {}\n", n)) + fixed("A", "ux, uy, rz") +
        turned.force("B", H, -P) +
        "[[output]]\nname = \"top\"\nkind = \"displacement\"\nat = \"B\"\ndirection = " +
        turned.vector(1.0, 0.0) +
        "\n[[output]]\nname = \"base\"\nkind = \"reaction\"\nat = \"A\"\nrotation = true\n"
        "[[output]]\nname = \"shear\"\nkind = \"reaction\"\nat = \"A\"\ndirection = " +
        turned.vector(1.0, 0.0) +
        "\n[[output]]\nname = \"foot\"\nkind = \"member_force\"\nat = [\"A\", \"B\"]\nquantity = "
        "\"M\"\nstation = "
        "0.0\n[[output]]\nname = \"inside\"\nkind = \"member_force\"\nat = [\"A\", \"B\"]\nquantity = "
        "\"M\"\nstation = 0.37\n[[output]]\nname = \"back\"\nkind = \"member_force\"\nat = [\"B\", "
        "\"A\"]\nquantity = \"M\"\nstation = 0.63\n[[output]]\nname = \"slope\"\nkind = \"member_force\"\nat "
        "= "
        "[\"A\", \"B\"]\nquantity = \"V\"\nstation = 0.37\n"
        "[[output]]\nname = \"later\"\nkind = \"member_force\"\nat = [\"A\", \"B\"]\nquantity = "
        "\"M\"\nstation = "
        "0.371\n[[output]]\nname = \"earlier\"\nkind = \"member_force\"\nat = [\"A\", \"B\"]\nquantity = "
        "\"M\"\nstation = 0.369\n";
    const outputs::Computed c = outputs::compute(text);
    CHECK(c.result.report.law_checks.violations.empty());
    const double top = c.last("top");
    errors.push_back(std::abs(top / (H * length / P * (std::tan(u) / u - 1.0)) - 1.0));
    // Of the structure where it stands: the force and the weight at their arms.
    CHECK(std::abs(c.last("base")) == doctest::Approx(H * length + P * top).epsilon(1e-9));
    CHECK(std::abs(c.last("foot")) == doctest::Approx(H * length + P * top).epsilon(1e-9));
    CHECK(c.last("shear") == doctest::Approx(-H).epsilon(1e-9));
    CHECK(c.last("inside") == doctest::Approx(-c.last("back")).epsilon(1e-9));
    CHECK(c.last("slope") ==
          doctest::Approx((c.last("later") - c.last("earlier")) / (0.002 * length)).epsilon(1e-5));
  }
  for (const double order : orders(errors)) CHECK(order == doctest::Approx(4.0).epsilon(0.05));
}

TEST_CASE("a portal's sway: amplified as the stability functions say, and not without") {
  // Columns clamped at both ends, a stiff girder that only sways: H h^3/(24 EI) 3 (tan v - v)/v^3, v = h/2 sqrt(P/EI).
  const double H = 0.05, P = 0.55 * euler(1.0), v = 0.5 * length * std::sqrt(P / EI);
  const double without = H * std::pow(length, 3) / (24.0 * EI);
  const auto sway = [&](int n, bool geometric) {
    const Model model = built(
        stood(geometric) + nodes({{"A", 0.0, 0.0}, {"B", 0.0, length}, {"C", 4.0, length}, {"D", 4.0, 0.0}}) +
        section(EA, EI, rho) + member("A, B", fmt::format("elements = {}\n", n)) +
        member("D, C", fmt::format("elements = {}\n", n)) + fixed("A, D", "ux, uy, rz") +
        "[[rigid]]\nname = \"girder\"\ncentre = [2.0, 3.5]\nnodes = [\"B\", \"C\"]\nmass = 1.0\ninertia = "
        "1.0\n" +
        fixed("girder", "rz") + force("B", 0.0, -P) + force("C", H, -P));
    for (int i = 0; i < model.size(); ++i)
      if (model.dofs[static_cast<std::size_t>(i)].displacement == "girder.ux") return model.u0[i];
    FAIL("no girder.ux");
    return 0.0;
  };
  CHECK(sway(3, false) == doctest::Approx(without).epsilon(1e-9));
  std::vector<double> errors;
  for (const int n : {2, 4, 8})
    errors.push_back(std::abs(sway(n, true) / (without * 3.0 * (std::tan(v) - v) / std::pow(v, 3)) - 1.0));
  for (const double order : orders(errors)) CHECK(order == doctest::Approx(4.0).epsilon(0.05));
  CHECK(errors.back() < 3e-5);
}

TEST_CASE("a start beyond its first load factor is refused with it, as is what cannot have one") {
  const auto refused = [](const std::string& text, const std::string& part,
                          const std::vector<Override>& more = {}) {
    try {
      static_cast<void>(built(text, more));
      FAIL("not refused: " << part);
    } catch (const SceneError& error) {
      CHECK(error.what() == doctest::Contains(part.c_str()));
      CHECK(error.what() == doctest::Contains("run.geometric"));
    }
  };
  const std::string cantilever = fixed("A", "ux, uy, rz");
  const double factor = 1.0 / 1.25, exact = euler(2.0) / factor;
  refused(column(cantilever, 8, exact), "0.8000016");  // of 8 elements, above 0.8 by 2.1e-6 of it
  CHECK(first_factor(column(cantilever, 8, euler(2.0) / 1.0001)) > 1.0);
  CHECK_NOTHROW(static_cast<void>(built(column(cantilever, 8, exact, false))));
  // Turned upside down it hangs, and stands.
  CHECK_NOTHROW(static_cast<void>(built(column(cantilever, 8, -exact))));
  refused(
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n[run]\nt_end = "
      "1.0\ngeometric = true\n[matrices]\ndofs = [\"a\"]\nmass = [[1.0]]\nstiffness = [[1.0]]\n",
      "[matrices]");
  // Without static loads there is nothing to freeze, and it is said.
  const Model idle = built(column(cantilever, 2, 0.0));
  REQUIRE(!idle.warnings.empty());
  bool said = false;
  for (const std::string& warning : idle.warnings)
    said = said || warning.find("run.geometric has no effect") != std::string::npos;
  CHECK(said);
}

TEST_CASE("a frictional start: K_g grows at its end, and the state is an equilibrium with it") {
  // A leaning column, held at its top by a pad with friction.
  for (const double friction : {0.072, 0.9}) {
    CAPTURE(friction);
    std::string text =
        column(fixed("A", "ux, uy") + "[[springs]]\nnode = \"A\"\nrotation_stiffness = 8.0\n", 4, 1.1) +
        force("B", 0.004, 0.0) +
        fmt::format(
            "[[contacts]]\nname = \"pad\"\nnode = \"B\"\nlaw = \"slider\"\ntangent = [1.0, "
            "0.0]\nnormal_force = 0.05\ntangential_stiffness = 2.0\nfriction = {}\n",
            friction);
    const Model model = built(text, {{"run.initial", "frictional"}});
    const Model plain = built(text, {{"run.initial", "frictional"}, {"run.geometric", "false"}});
    REQUIRE(model.statics.stages.size() == 2);
    CHECK(model.statics.stages.back().stage == "geometric");
    const double T = model.statics.stages.back().T[0];
    Vector rest = model.stiffness * model.u0;
    model.contacts[0].tangent.add_to(rest, T);
    for (const Load& load : model.loads)
      if (load.is_static) load.direction.add_to(rest, -load.history.value(0.0));
    CHECK(rest.cwiseAbs().maxCoeff() < 1e-10);
    // What it leaned by is more, and the weak pad slides only then.
    CHECK(model.contacts[0].tangent.dot(model.u0) > 1.1 * plain.contacts[0].tangent.dot(plain.u0));
    if (friction < 0.5) CHECK(slip_sign(model.statics.stages.back().states[0]) == 1);
    CHECK(plain.statics.stages.back().states[0] == State::stick);
  }
}

TEST_CASE("in other units: the same factors; supports that both move strain nothing") {
  const double P = 0.4 * euler(1.0);
  const std::string text = column(fixed("A", "ux, uy") + fixed("B", "ux"), 5, P);
  const double factor = first_factor(text);
  std::string small = text;  // N, t, mm, s
  const auto put = [&](const std::string& from, const std::string& to) {
    const std::size_t at = small.find(from);
    REQUIRE(at != std::string::npos);
    small.replace(at, from.size(), to);
  };
  put("\"kN\"", "\"N\"");
  put("length = \"m\"", "length = \"mm\"");
  put("B = [0, 3]", "B = [0, 3000]");
  put("EA = 500000", "EA = 500000000");
  put("EI = 7", "EI = 7e9");
  put("mass_per_length = 0.3", "mass_per_length = 0.0003");
  put(fmt::format("amplitude = {:.17g}", P), fmt::format("amplitude = {:.17g}", 1000.0 * P));
  CHECK(first_factor(small) == doctest::Approx(factor).epsilon(1e-11));

  std::string moved = column(
      fixed("A", "uy") + fixed("A", "ux", "motion = 0.02\n") + fixed("B", "ux", "motion = 0.02\n"), 3, P);
  const Model model = built(moved);
  for (int i = 0; i < model.size(); ++i) {
    const std::string& name = model.dofs[static_cast<std::size_t>(i)].displacement;
    if (name.ends_with(".ux")) CHECK(model.u0[i] == doctest::Approx(0.02).epsilon(1e-9));
  }
}

TEST_CASE("a loaded column that swings against a stop: both flows, ida, energy, sensitivities") {
  const double P = 0.7 * euler(2.0);
  const std::string text =
      column(fixed("A", "ux, uy, rz"), 8, P) +
      "[damping]\nalpha = 0.05\n[[contacts]]\nname = \"stop\"\nnode = \"B\"\nlaw = \"compliant\"\nnormal = "
      "[-1.0, 0.0]\ngap = 0.01\nnormal_stiffness = 500.0\n[[loads]]\nnode = \"B\"\ndirection = [1.0, "
      "0.0]\namplitude = 0.02\nhistory = { type = \"step\", start = 0.01 }\n";
  const auto run = [&](const std::string& engine, const std::string& flow) {
    const Scene scene = parse_scene(text, "test.toml",
                                    {{"run.engine", engine},
                                     {"run.flow", flow},
                                     {"run.t_end", "4.0"},
                                     {"run.rtol", "1e-9"},
                                     {"run.certify", "false"}});
    return simulate(build_model(scene), scene.run);
  };
  const Result series = run("exact", "taylor"), modal = run("exact", "modal"), ida = run("ida", "auto");
  REQUIRE(series.events.size() > 1);
  for (const auto& [other, bound] : {std::pair(&modal, 1e-9), std::pair(&ida, 1e-6)}) {
    CHECK(other->report.law_checks.violations.empty());
    REQUIRE(other->events.size() == series.events.size());
    for (std::size_t i = 0; i < series.events.size(); ++i)
      CHECK(std::abs(other->events[i].t - series.events[i].t) < bound);
  }
  CHECK(series.report.audit.energy.value < 1e-10 * series.report.audit.energy_scale);
  // N depends on the load, and K_g on N.
  const auto contact_event = [](const std::vector<Event>& events) {
    return std::find_if(events.begin(), events.end(), [](const Event& e) { return e.contact >= 0; });
  };
  const double h = 1e-4;
  const std::string path = "loads.1.amplitude";
  const auto first_event = [&](double amplitude) {
    const Scene scene = parse_scene(text, "test.toml",
                                    {{path, fmt::format("{:.17g}", amplitude)},
                                     {"run.engine", "exact"},
                                     {"run.flow", "taylor"},
                                     {"run.certify", "false"}});
    const Result result = simulate(build_model(scene), scene.run);
    return contact_event(result.events)->t;
  };
  const double difference = (8.0 * (first_event(P * (1.0 + h)) - first_event(P * (1.0 - h))) -
                             (first_event(P * (1.0 + 2.0 * h)) - first_event(P * (1.0 - 2.0 * h)))) /
                            (12.0 * h * P);
  const Sensitivities rates = rates_of(text, {path});
  const auto at = static_cast<std::size_t>(contact_event(rates.events) - rates.events.begin());
  REQUIRE(at < rates.event_rates.size());
  CHECK(std::abs(difference) > 1e-3);
  CHECK(rates.event_rates[at][0].t == doctest::Approx(difference).epsilon(1e-6));
}

TEST_CASE("a reduced model of a loaded frame is the frame; one that is unstable when open is refused") {
  const std::string text =
      column(fixed("A", "ux, uy, rz"), 6, 0.7 * euler(2.0)) +
      "[[loads]]\nnode = \"B\"\ndirection = [1.0, 0.0]\namplitude = 0.02\nhistory = { type "
      "= \"step\", start = 0.01 }\n[damping]\nalpha = 0.1\nbeta = 1e-4\n";
  const auto last = [&](const std::vector<Override>& more) {
    std::vector<Override> changes{{"run.certify", "false"}, {"run.flow", "taylor"}};
    changes.insert(changes.end(), more.begin(), more.end());
    const Scene scene = parse_scene(text, "test.toml", changes);
    const Model model = build_model(scene);
    return Vector(simulate(model, scene.run).rows.back().u);
  };
  const Vector whole = last({}), reduced = last({{"reduction.cutoff_omega", "1e9"}});
  CHECK((whole - reduced).cwiseAbs().maxCoeff() < 1e-9 * whole.cwiseAbs().maxCoeff());

  const std::string held =
      column(fixed("A", "ux, uy, rz"), 4, 1.5 * euler(2.0)) +
      "[[contacts]]\nname = \"left\"\nnode = \"B\"\nlaw = \"compliant\"\nnormal = [1.0, "
      "0.0]\nnormal_stiffness = 50.0\ngap = -1e-3\n[[contacts]]\nname = \"right\"\nnode = "
      "\"B\"\nlaw = \"compliant\"\nnormal = [-1.0, 0.0]\nnormal_stiffness = 50.0\ngap = "
      "-1e-3\n";
  const Model model = built(held);
  CHECK(model.geometric->load_factors.front() > 1.0);
  bool said = false;
  for (const std::string& warning : model.warnings)
    said = said || warning.find("unstable with all its contacts open") != std::string::npos;
  CHECK(said);
  CHECK_THROWS_WITH_AS(static_cast<void>(built(held, {{"reduction.cutoff_omega", "100.0"}})),
                       doctest::Contains("run.geometric"), SceneError);
}

TEST_CASE("large structures by Lanczos: the same factors as small ones") {
  // 80 elements, 240 degrees of freedom, beside 40.
  const double P = 0.3 * euler(1.0);
  const std::string pinned = fixed("A", "ux, uy") + fixed("B", "ux");
  const std::string foot =
      "[[contacts]]\nname = \"foot\"\nnode = \"B\"\nlaw = \"rigid\"\nnormal = [1.0, "
      "0.0]\nfriction = 0.0\n[[loads]]\nnode = \"B\"\ndirection = [-1.0, 0.0]\namplitude = 1.0\n";
  for (const std::string& supports : {pinned, fixed("A", "ux, uy") + foot}) {
    const double factor = first_factor(column(supports, 80, P)) * P / euler(1.0) - 1.0;
    const double coarse = first_factor(column(supports, 40, P)) * P / euler(1.0) - 1.0;
    CHECK(std::abs(coarse - 16.0 * factor) < 3e-9);
    CHECK(std::abs(factor) < 5e-9);
  }
  // Held rigidly in its middle it buckles in two half waves, at four times the load; elsewhere as a small one does.
  const auto held = [&](double place, const char* elements) {
    std::string text = column(pinned, 40, P) +
                       "[[contacts]]\nname = \"foot\"\nnode = \"M\"\nlaw = \"rigid\"\nnormal = [1.0, "
                       "0.0]\nfriction = 0.0\n[[loads]]\nnode = \"M\"\ndirection = [-1.0, 0.0]\namplitude = "
                       "1.0\n";
    text.insert(text.find("B = ["), fmt::format("M = [0.0, {}]\n", place * length));
    text.replace(text.find("\"A\", \"B\""), 8, "\"A\", \"M\", \"B\"");
    text.replace(text.find("elements = 40"), 13, elements);
    return first_factor(text) * P / euler(1.0);
  };
  CHECK(std::abs(held(0.5, "elements = [40, 40]") / 4.0 - 1.0) < 1e-7);
  const double fine = held(0.3, "elements = [24, 56]");
  CHECK(fine == doctest::Approx(held(0.3, "elements = [12, 28]")).epsilon(1e-5));
  CHECK(fine > 1.0);
  CHECK(fine < 4.0);
}

TEST_SUITE_END();

}  // namespace signorini::tests::geometric
