// A reduced model: modes up to the cutoff, and the static compliance of all others.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>

#include "base/eigen_dense.hpp"
#include "model/assembly/springs.hpp"
#include "model/reduce/reduction.hpp"
#include "study/check/check.hpp"
#include "unit/model/scenes.hpp"

using namespace signorini;
using namespace signorini::test;

namespace {

Scene cut(Scene scene, double omega) {
  scene.reduction = ReductionSpec{omega, {}, {}, {scene.file, 1, 1}};
  return scene;
}

/// Clamped at L, on a contact in the middle and one at the end, loaded between them.
Scene cantilever() {
  Scene s = beam(12.0, 8, 9e6, 2e6, 0.4);
  s.nodes = {{"L", 0.0, 0.0, {}}, {"P", 4.5, 0.0, {}}, {"M", 6.0, 0.0, {}}, {"R", 12.0, 1.0, {}}};
  s.members = {member({"L", "P", "M", "R"}, "s", {3, 1, 4})};
  s.supports = {support("L", true, true, true)};
  s.contacts = {support_contact("middle", "M", 1e5), support_contact("end", "R", 1e5)};
  for (ContactSpec& c : s.contacts) c.gap = 0.01;
  s.loads = {node_load("P", {0.6, 0.8}, 10.0)};
  return s;
}

/// Greatest displacement along the form for a unit force along `force`; K regular.
double give(const Model& model, const Combination& form, const Combination& force) {
  const Eigen::MatrixXd k(model.stiffness);
  return form.dot(Vector(base::solve_dense(k, assembly::dense_vector(force, model.size()))));
}

/// The same for a structure with free motions, the whole of which are taken out by inertia (independently of
/// the implementation: all modes of a dense decomposition; M regular).
double give_elastic(const Model& model, const Combination& form, const Combination& force) {
  const base::EigenPairs modes =
      base::generalized_eigen(Eigen::MatrixXd(model.stiffness), Eigen::MatrixXd(model.mass));
  double sum = 0.0;
  for (Eigen::Index j = 0; j < modes.values.size(); ++j) {
    if (modes.values[j] < 1.0) continue;  // free
    const Vector phi = modes.vectors.col(j);
    sum += form.dot(phi) * force.dot(phi) / modes.values[j];
  }
  return sum;
}

/// That of the reduced model; its K is diagonal, zero on free modes.
double give_reduced(const Model& model, const Combination& form, const Combination& force) {
  const Vector k = model.stiffness.diagonal(), f = assembly::dense_vector(force, model.size()),
               g = assembly::dense_vector(form, model.size());
  double sum = 0.0;
  for (int i = 0; i < model.size(); ++i)
    if (k[i] > 0.0) sum += f[i] * g[i] / k[i];
  return sum;
}

}  // namespace

TEST_SUITE_BEGIN("unit/model/reduce/reduction");

TEST_CASE("above all frequencies nothing is left out") {
  const Model whole = build_model(pipeline());
  const Model model = build_model(cut(pipeline(), 1e9));
  REQUIRE(model.reduction);
  CHECK(model.size() == whole.size());
  CHECK(model.reduction->modes == 51);
  CHECK(model.reduction->free_modes == 3);
  CHECK(model.reduction->truncated_modes == 0);
  CHECK(model.reduction->first_truncated == 0.0);
  CHECK(model.reduction->massless_shapes == 0);
  CHECK(model.omega_max == doctest::Approx(whole.omega_max).epsilon(1e-9));
  CHECK(model.alpha == whole.alpha);
  for (const ComplianceShare& share : model.reduction->shares)
    CHECK(share.residual <= 1e-10 * share.compliance);
}

TEST_CASE("K and M of the physical structure, seen through the shapes, are those of the model") {
  const Model whole = build_model(pipeline());
  for (const double cutoff : {300.0, 3000.0}) {
    const Model model = build_model(cut(pipeline(), cutoff));
    const Eigen::MatrixXd& r = model.reduction->shapes;
    const Eigen::MatrixXd k = r.transpose() * (whole.stiffness * r), m = r.transpose() * (whole.mass * r);
    // Rounding of the energy of free motions may be negative.
    const Vector size = k.diagonal().cwiseMax(0.0).cwiseSqrt();
    for (int i = 0; i < model.size(); ++i)
      for (int j = 0; j < model.size(); ++j) {
        CHECK(std::abs(k(i, j) - model.stiffness.coeff(i, j)) <= 1e-9 * size[i] * size[j] + 1e-6);
        const bool massless = model.dofs[static_cast<std::size_t>(i)].massless ||
                              model.dofs[static_cast<std::size_t>(j)].massless;
        if (!massless)
          CHECK(std::abs(m(i, j) - model.mass.coeff(i, j)) <= 1e-10 * std::sqrt(m(i, i) * m(j, j)));
        else
          CHECK(model.mass.coeff(i, j) == 0.0);
      }
  }
}

TEST_CASE("every shape has a greatest translation of 1, and tolerances keep their meaning") {
  const Model model = build_model(cut(pipeline(), 2000.0));
  const double arm = model.scales.displacement / model.scales.rotation;
  for (int j = 0; j < model.size(); ++j) {
    double size = 0.0;
    for (std::size_t i = 0; i < model.reduction->dofs.size(); ++i)
      size = std::max(size, std::abs(model.reduction->shapes(static_cast<Eigen::Index>(i), j)) *
                                (model.reduction->dofs[i].rotation ? arm : 1.0));
    CHECK(size == doctest::Approx(1.0).epsilon(1e-12));
    CHECK_FALSE(model.dofs[static_cast<std::size_t>(j)].rotation);
  }
}

TEST_CASE("the static start is that of the full model, whatever is left out") {
  const Model whole = build_model(pipeline());
  for (const double cutoff : {1.0, 100.0, 1000.0, 10000.0, 1e6}) {
    INFO(cutoff);
    const Model model = build_model(cut(pipeline(), cutoff));
    const Vector u = model.reduction->physical(model.u0);
    CHECK((u - whole.u0).cwiseAbs().maxCoeff() <= 1e-10 * whole.scales.displacement);
    CHECK(model.reduction->initial_displacement_lost <= 1e-10 * whole.scales.displacement);
    Vector rest = model.stiffness * model.u0;
    for (const Load& load : model.loads)
      if (load.is_static) load.direction.add_to(rest, -load.history.value(0.0));
    for (std::size_t k = 0; k < 2; ++k) {
      const Contact& c = model.contacts[k];
      const double n = c.normal_stiffness * (c.gap + c.normal.dot(model.u0));
      CHECK(-n == doctest::Approx(whole.statics.reactions[k]).epsilon(1e-9));
      c.normal.add_to(rest, n);
    }
    CHECK(rest.cwiseAbs().maxCoeff() <= 1e-8 * whole.scales.force);
  }
}

TEST_CASE("compliance at contacts and loads, and between them, is that of the full model") {
  const Model whole = build_model(cantilever());
  for (const double cutoff : {100.0, 600.0, 5000.0, 1e9}) {
    const Model model = build_model(cut(cantilever(), cutoff));
    INFO(cutoff, " ", model.size(), " of ", whole.size());
    std::vector<std::pair<const Combination*, const Combination*>> forms;
    for (std::size_t k = 0; k < 2; ++k) {
      forms.emplace_back(&whole.contacts[k].normal, &model.contacts[k].normal);
      forms.emplace_back(&whole.contacts[k].tangent, &model.contacts[k].tangent);
    }
    forms.emplace_back(&whole.loads[0].direction, &model.loads[0].direction);
    for (const auto& [form, reduced_form] : forms)
      for (const auto& [force, reduced_force] : forms) {
        const double size = std::sqrt(give(whole, *form, *form) * give(whole, *force, *force));
        CHECK(std::abs(give_reduced(model, *reduced_form, *reduced_force) - give(whole, *form, *force)) <=
              1e-9 * size);
      }
  }
}

TEST_CASE("a free structure: three free modes, and the elastic compliance complete") {
  const Model whole = build_model(pipeline());
  for (const double cutoff : {1.0, 500.0, 5000.0}) {
    INFO(cutoff);
    const Model model = build_model(cut(pipeline(), cutoff));
    CHECK(model.reduction->free_modes == 3);
    CHECK((model.stiffness.diagonal().head(3).array() == 0.0).all());
    for (std::size_t k = 0; k < 2; ++k)
      for (const bool normal : {true, false}) {
        const Combination& a = normal ? whole.contacts[k].normal : whole.contacts[k].tangent;
        const Combination& b = normal ? model.contacts[k].normal : model.contacts[k].tangent;
        CHECK(give_reduced(model, b, b) == doctest::Approx(give_elastic(whole, a, a)).epsilon(1e-8));
      }
  }
}

TEST_CASE("what is reported: frequencies on both sides of the cutoff, shares, ringing") {
  const Model model = build_model(cut(pipeline(), 1000.0));
  const Reduction& r = *model.reduction;
  CHECK(r.cutoff == 1000.0);
  CHECK(r.modes + r.truncated_modes == 51);
  CHECK(r.highest_kept <= 1000.0);
  CHECK(r.first_truncated > 1000.0);
  REQUIRE(r.shares.size() == 6);  // two contacts, gravity, one load
  CHECK(r.shares[0].label == "normal of contact 'first'");
  CHECK(r.shares[3].label == "tangent of contact 'second'");
  CHECK(r.shares[4].label == "gravity");
  CHECK(r.shares[5].label == "load 1");
  for (const std::size_t i : {0u, 1u, 2u, 3u, 5u}) {
    CHECK(r.shares[i].residual > 0.0);
    CHECK(r.shares[i].residual < r.shares[i].compliance);
  }
  CHECK(r.shares[4].compliance == 0.0);  // weight only moves a free body as a whole
  CHECK(r.massless_shapes == 5);
  // The 100 kN that jump, on what is left out of the compliance under them, at node B.
  CHECK(r.ringing <= 100.0 * r.shares[5].residual * std::sqrt(2.0));
  CHECK(r.ringing >= 100.0 * r.shares[5].residual * std::sqrt(0.5));
  const Model finer = build_model(cut(pipeline(), 4000.0));
  CHECK(finer.reduction->ringing < r.ringing);
}

TEST_CASE("check describes the full structure, and the cost of the reduced one") {
  Scene whole = pipeline();
  whole.loads[0].history.start = 0.01;  // a jump at t = 0 would already show in the forces at contacts
  const Scene small = cut(whole, 1000.0);
  const check::CheckReport a = check::check(whole, build_model(whole)),
                           b = check::check(small, build_model(small));
  CHECK(b.degrees_of_freedom == 51);
  CHECK(b.massless == 0);
  CHECK(b.mass->total == a.mass->total);
  CHECK(b.mass->moving_x == a.mass->moving_x);
  REQUIRE(b.stuck.modes.size() == a.stuck.modes.size());
  for (std::size_t i = 0; i < a.stuck.modes.size(); ++i)
    CHECK(b.stuck.modes[i].omega == a.stuck.modes[i].omega);
  CHECK(b.cost.unknowns < a.cost.unknowns / 2);
  CHECK(b.cost.omega_max < 0.05 * a.cost.omega_max);
  CHECK(b.contacts[0].N == doctest::Approx(a.contacts[0].N).epsilon(1e-8));
}

TEST_CASE(
    "Rayleigh damping of each mode stays what it was; static shapes creep where all modes left out do") {
  // beta omega = 2 of the first mode left out: critical damping, between the last two.
  const double first = build_model(cut(pipeline(), 1000.0)).reduction->first_truncated;
  for (const double beta : {2e-4, 1.99 / first, 2.01 / first}) {
    CAPTURE(beta);
    Scene scene = pipeline();
    scene.damping = {};
    scene.damping.alpha = 3.0;
    scene.damping.beta = beta;
    const Model model = build_model(cut(scene, 1000.0));
    const Eigen::MatrixXd c(model.damping);
    const Vector k = model.stiffness.diagonal(), m = model.mass.diagonal();
    for (int i = 0; i < model.size(); ++i) {
      const bool damped = !model.dofs[static_cast<std::size_t>(i)].massless || beta * first > 2.0;
      for (int j = 0; j < model.size(); ++j)
        CHECK(c(i, j) == (i == j ? doctest::Approx(3.0 * m[i] + (damped ? beta * k[i] : 0.0)).epsilon(1e-14)
                                 : doctest::Approx(0.0).epsilon(1e-300)));
    }
  }
}

TEST_CASE("single dampers: each static shape has its own time constant or none") {
  Scene scene = cantilever();
  Spring damper;
  damper.node = "M";
  damper.direction = {0.0, 1.0};
  damper.damping = 20.0;
  scene.springs = {damper};
  const Model whole = build_model(scene), model = build_model(cut(scene, 300.0));
  const Eigen::MatrixXd c(model.damping);
  int damped = 0;
  for (int i = 0; i < model.size(); ++i) {
    if (!model.dofs[static_cast<std::size_t>(i)].massless) continue;
    damped += c(i, i) > 0.0;
    for (int j = 0; j < model.size(); ++j) {
      if (j != i && model.dofs[static_cast<std::size_t>(j)].massless)
        CHECK(std::abs(c(i, j)) <= 1e-10 * c.cwiseAbs().maxCoeff());
      if (c(i, i) == 0.0) CHECK(c(i, j) == 0.0);
    }
  }
  CHECK(damped == 1);
  const Eigen::MatrixXd& r = model.reduction->shapes;
  const Eigen::MatrixXd seen = r.transpose() * (whole.damping * r);
  CHECK((seen - c).cwiseAbs().maxCoeff() <= 1e-9 * seen.cwiseAbs().maxCoeff());
}

TEST_CASE("rigid contacts meet shapes with mass only, and each has an effective mass") {
  Scene scene = cantilever();
  scene.contacts[0].law = Law::rigid;
  scene.contacts[0].tangential_stiffness.reset();
  for (const double cutoff : {1.0, 100.0, 1000.0}) {
    INFO(cutoff);
    const Model model = build_model(cut(scene, cutoff));
    CHECK(model.reduction->massive_shapes == 2);
    CHECK(model.reduction->massless_shapes >= 2);
    CHECK(model.reduction->highest_massive > model.reduction->first_truncated);
    for (const Combination* form : {&model.contacts[0].normal, &model.contacts[0].tangent}) {
      double response = 0.0;
      for (const auto& [dof, factor] : form->terms) {
        CHECK_FALSE(model.dofs[static_cast<std::size_t>(dof)].massless);
        response += factor * factor / model.mass.coeff(dof, dof);
      }
      CHECK(response > 0.0);
      // Nothing was cut off: what the massless shapes have along the form is rounding.
      const Vector f =
          model.reduction->shapes.transpose() *
          assembly::dense_vector(form == &model.contacts[0].normal ? build_model(scene).contacts[0].normal
                                                                   : build_model(scene).contacts[0].tangent,
                                 static_cast<int>(model.reduction->dofs.size()));
      CHECK((f - assembly::dense_vector(*form, model.size())).cwiseAbs().maxCoeff() <= 1e-9);
    }
  }
}

TEST_CASE("parts without mass are condensed into the modes, and into the static shapes") {
  Scene scene = cantilever();
  scene.members[0].mass = MassKind::lumped;  // rotations are massless
  const Model whole = build_model(scene);
  const Model model = build_model(cut(scene, 1e9));
  CHECK(model.reduction->modes == 16);  // two translations at eight free nodes
  CHECK(model.omega_max == doctest::Approx(whole.omega_max).epsilon(1e-8));
  CHECK(give_reduced(model, model.contacts[1].normal, model.contacts[1].normal) ==
        doctest::Approx(give(whole, whole.contacts[1].normal, whole.contacts[1].normal)).epsilon(1e-9));
}

TEST_CASE("a large structure: Lanczos iteration finds the modes that a dense decomposition finds") {
  Scene scene = beam(12.0, 150, 9e6, 2e6, 0.4);
  scene.contacts = {support_contact("left", "L", 1e5)};
  const Model model = build_model(cut(scene, 3000.0));
  CHECK(model.reduction->dofs.size() == 453);
  // Bending of a free beam: (beta L)^2 sqrt(EI/m)/L^2; along: k pi sqrt(EA/m)/L.
  const double bending = std::sqrt(2e6 / 0.4) / 144.0, along = std::sqrt(9e6 / 0.4) / 12.0 * std::acos(-1.0);
  std::vector<double> expected;
  for (const double x :
       {4.730040744862704, 7.853204624095838, 10.995607838001671, 14.137165491257464, 17.278759657399481})
    expected.push_back(x * x * bending);
  for (int k = 6; k < 40; ++k) expected.push_back(std::pow((k + 0.5) * std::acos(-1.0), 2) * bending);
  for (int k = 1; k < 4; ++k) expected.push_back(k * along);
  std::sort(expected.begin(), expected.end());
  const auto kept = std::upper_bound(expected.begin(), expected.end(), 3000.0);
  CHECK(model.reduction->modes == 3 + static_cast<int>(kept - expected.begin()));
  CHECK(model.reduction->highest_kept == doctest::Approx(*(kept - 1)).epsilon(1e-4));
  CHECK(model.reduction->first_truncated == doctest::Approx(*kept).epsilon(1e-4));
}

namespace {

/// `count` equal cantilevers that nothing joins, each of three elements, a contact at the end of each.
Scene equal_cantilevers(int count) {
  Scene s = empty_scene();
  s.sections = {{"s", 9e6, 2e6, 0.4}};
  for (int i = 0; i < count; ++i) {
    const std::string from = "A" + std::to_string(i), to = "B" + std::to_string(i);
    s.nodes.push_back({from, 0.0, 20.0 * i, {}});
    s.nodes.push_back({to, 12.0, 20.0 * i, {}});
    s.members.push_back(member({from, to}, "s", {3}));
    s.supports.push_back(support(from, true, true, true));
    s.contacts.push_back(support_contact("c" + std::to_string(i), to, 1e5));
  }
  return s;
}

}  // namespace

TEST_CASE("a large structure of equal parts: each repeated mode is found as often as it is there") {
  const Model one = build_model(equal_cantilevers(1)), all = build_model(cut(equal_cantilevers(1), 1e9));
  const Vector omega =
      base::generalized_eigenvalues(Eigen::MatrixXd(one.stiffness), Eigen::MatrixXd(one.mass)).cwiseSqrt();
  for (int kept = 1; kept <= 2; ++kept) {
    const Model model = build_model(cut(equal_cantilevers(60), 0.5 * (omega[kept - 1] + omega[kept])));
    const Reduction& r = *model.reduction;
    CHECK(r.dofs.size() == 540);
    CHECK(r.modes == 60 * kept);
    CHECK(r.truncated_modes == 60 * (9 - kept));
    CHECK(r.highest_kept == doctest::Approx(omega[kept - 1]).epsilon(1e-9));
    CHECK(r.first_truncated == doctest::Approx(omega[kept]).epsilon(1e-9));
    for (const std::size_t c : {0u, 1u, 40u, 119u})  // normals and tangents: alike at all of them
      CHECK(r.shares[c].compliance == doctest::Approx(all.reduction->shares[c % 2].compliance).epsilon(1e-9));
  }
}

TEST_CASE(
    "a large free structure, a cutoff far below its modes: the first left out is that of other cutoffs") {
  Scene scene = beam(12.0, 150, 9e6, 2e6, 0.4);
  const double first = build_model(cut(scene, 100.0)).reduction->first_truncated;
  CHECK(first ==
        doctest::Approx(4.730040744862704 * 4.730040744862704 * std::sqrt(2e6 / 0.4) / 144.0).epsilon(1e-6));
  for (const double cutoff : {1e-2, 1.0, 10.0}) {
    INFO(cutoff);
    const Model model = build_model(cut(scene, cutoff));
    CHECK(model.reduction->modes == 3);
    CHECK(model.reduction->first_truncated == doctest::Approx(first).epsilon(1e-8));
  }
}

TEST_CASE("only rotations that the modes cannot represent are reported, too") {
  Scene scene = cantilever();
  scene.initial.components = {{"R", "rz", 0.01, {}}};
  Scene beside = cantilever();
  beside.initial.components = {{"R", "wz", 0.5, {}}};
  const Model turned = build_model(cut(scene, 100.0)), turning = build_model(cut(beside, 100.0));
  const double arm = turned.scales.displacement / turned.scales.rotation;
  CHECK(turned.reduction->initial_displacement_lost > 1e-3 * arm);
  CHECK(turning.reduction->initial_velocity_lost >
        0.05 * turning.scales.velocity / turning.scales.angular_velocity);
}

TEST_CASE("an initial state that the modes cannot represent is reported") {
  Scene scene = cantilever();
  scene.initial.components = {{"R", "uy", 0.001, {}}, {"P", "vx", 0.5, {}}};
  const Model coarse = build_model(cut(scene, 100.0)), fine = build_model(cut(scene, 1e9));
  CHECK(coarse.reduction->initial_displacement_lost > 1e-5);
  CHECK(coarse.reduction->initial_velocity_lost > 1e-2);
  CHECK(fine.reduction->initial_displacement_lost < 1e-12);
  CHECK(fine.reduction->initial_velocity_lost < 1e-9);
  CHECK((fine.reduction->physical(fine.v0) - build_model(scene).v0).cwiseAbs().maxCoeff() < 1e-9);
  // As much of the opposite state.
  for (auto& component : scene.initial.components) component.value = -component.value;
  const Model opposite = build_model(cut(scene, 100.0));
  CHECK(opposite.reduction->initial_displacement_lost ==
        doctest::Approx(coarse.reduction->initial_displacement_lost).epsilon(1e-12));
  CHECK(opposite.reduction->initial_velocity_lost ==
        doctest::Approx(coarse.reduction->initial_velocity_lost).epsilon(1e-12));
}

TEST_CASE("gaps of rigid contacts start as they were, also where the state is projected") {
  Scene scene = cantilever();
  scene.contacts[1].law = Law::rigid;
  scene.contacts[1].tangential_stiffness.reset();
  scene.contacts[1].gap = 0.002;
  scene.initial.components = {{"R", "uy", -0.002, {}}, {"R", "vy", 0.3, {}}};
  const Model model = build_model(cut(scene, 100.0));
  const Contact& c = model.contacts[1];
  CHECK(std::abs(c.gap + c.normal.dot(model.u0)) < 1e-15);
  CHECK(c.normal.dot(model.v0) == doctest::Approx(0.3).epsilon(1e-12));
}

TEST_CASE("refused: no mode and no mass, a massless part that only a contact holds, an unstable structure") {
  Scene low = cantilever();
  CHECK(contains(refusal(cut(low, 1.0)), "no mode lies below the cutoff"));

  Scene loose = matrices({{1.0, 0.0}, {0.0, 0.0}}, {{0.0, 0.0}, {0.0, 0.5}}, {{4.0, 0.0}, {0.0, 0.0}});
  loose.loads = {};
  CHECK(refusal(loose).empty());
  CHECK(contains(refusal(cut(loose, 1.0)), "d1.u has no mass"));

  Scene unstable = matrices({{1.0, 0.0}, {0.0, 1.0}}, {}, {{4.0, 0.0}, {0.0, -1.0}});
  unstable.matrices->damping = {};
  CHECK(refusal(unstable).empty());
  CHECK(contains(refusal(cut(unstable, 10.0)), "negative eigenvalue"));
}
