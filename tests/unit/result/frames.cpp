// Deformed shapes on disk and as pictures.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include "result/frames.hpp"
#include "result/plots.hpp"
#include "result/run_directory.hpp"
#include "unit/model/scenes.hpp"
#include "unit/result/made_up.hpp"

using namespace signorini;
using namespace signorini::made_up;

namespace {

/// A cantilever of two elements from L to R with a tip displacement, a contact at its tip.
struct Tip {
  Scene scene = test::beam(4.0, 2, 1e6, 2e3, 0.1);
  Model model;
  Vector u, v;
  Tip() {
    scene.supports = {test::support("L", true, true, true)};
    scene.contacts = {test::support_contact("foot", "R", 1e6)};
    scene.resolved = "schema = 1\n";
    model = build_model(scene);
    u = v = Vector::Zero(model.size());
    u[test::dof(model, "R.uy")] = 0.02;
    u[test::dof(model, "R.ux")] = 0.01;
  }
  void feed(result::RunDirectory& directory, double t, bool frame) const {
    Sample s;
    s.t = t;
    s.u = &u;
    s.v = &v;
    s.contacts = {{State::stick, 0.0, 0.01, 0.0, 0.0, -30.0, 4.0}};
    directory.sample(s);
    if (frame) directory.frame(s);
  }
};

}  // namespace

TEST_SUITE_BEGIN("unit/result/frames");

TEST_CASE("frames: two rows an element, one a named node, forces on the body") {
  const Folder folder;
  const Tip tip;
  result::RunDirectory directory(folder / "run", tip.scene, tip.model);
  tip.feed(directory, 0.0, false);
  CHECK_FALSE(std::filesystem::exists(folder / "run" / "frames.csv"));
  tip.feed(directory, 0.5, true);
  CHECK(slurp(folder / "run" / "frames.csv") ==
        "t,kind,element,node,x,y,ux,uy,rz\n"
        "0.5,beam,1,L,0,0,0,0,0\n"
        "0.5,beam,1,L-R.1,2,0,0,0,0\n"
        "0.5,beam,2,L-R.1,2,0,0,0,0\n"
        "0.5,beam,2,R,4,0,0.01,0.02,0\n"
        "0.5,support,,L,0,0,0,0,0\n"
        "0.5,node,,R,4,0,0.01,0.02,0\n");
  CHECK(slurp(folder / "run" / "frame_contacts.csv") ==
        "t,contact,state,node,x,y,ux,uy,nx,ny,tx,ty,N,T\n"
        "0.5,foot,stick,R,4,0,0.01,0.02,0,1,1,0,-30,4\n");
  const auto frames = result::read_frames(result::TableFolder(folder / "run"), 0.0, 1.0);
  REQUIRE(frames.size() == 1);
  REQUIRE(frames[0].elements.size() == 2);
  REQUIRE(frames[0].forces.size() == 1);
  CHECK(frames[0].forces[0].fx == -4.0);
  CHECK(frames[0].forces[0].fy == 30.0);
  CHECK(result::read_frames(result::TableFolder(folder / "run"), 0.6, 1.0).empty());
}

TEST_CASE("frames: the drawn curve is the beam's own, and magnification keeps it readable") {
  result::Frame::Element e{"beam", {0.0, 0.0, 0.0, 0.0, 0.0}, {2.0, 0.0, 0.0, 0.0, 0.0}};
  e.b.rz = 0.4;
  // A turned end without displacement: u = L (s^3 - s^2) rz.
  CHECK(result::between(e, 0.5).uy == doctest::Approx(-2.0 * 0.125 * 0.4));
  CHECK(result::between(e, 0.5).ux == 0.0);
  e.kind = "bar";
  CHECK(result::between(e, 0.5).uy == 0.0);

  result::Frame frame;
  frame.elements = {{"beam", {0.0, 0.0, 0.0, 0.0, 0.0}, {10.0, 0.0, 0.0, 3e-3, 0.0}}};
  frame.points = {{"L", true, frame.elements[0].a}, {"R", false, frame.elements[0].b}};
  CHECK(result::scales_of({frame}).magnification == 200.0);
  frame.points[1].at.uy = 20.0;
  CHECK(result::scales_of({frame}).magnification == 1.0);
}

TEST_CASE("frames: a far slide is drawn in true scale, what is left of it magnified") {
  result::Frame frame;
  frame.points = {{"L", false, {0.0, 0.0, 0.51, 0.0, 0.0}}, {"R", false, {10.0, 0.0, 0.49, 0.0, 0.0}}};
  frame.elements = {{"bar", frame.points[0].at, frame.points[1].at}};
  std::vector<result::Frame> frames{frame};
  result::subtract_translations(frames);
  CHECK(frames[0].translation_x == doctest::Approx(0.5));
  CHECK(frames[0].points[0].at.x == doctest::Approx(0.5));
  CHECK(frames[0].points[0].at.ux == doctest::Approx(0.01));
  CHECK(frames[0].elements[0].b.ux == doctest::Approx(-0.01));
  CHECK(result::scales_of(frames).magnification == 100.0);
  frame.points[1].at.ux = -0.4;  // a deformation as large as the motion: nothing is taken out
  frames = {frame};
  result::subtract_translations(frames);
  CHECK(frames[0].translation_x == 0.0);
  CHECK(frames[0].points[0].at.ux == 0.51);
}

TEST_CASE("frames: the longest arrow is that of the run, whether or not a frame shows it") {
  result::Frame frame;
  frame.points = {{"L", true, {0.0, 0.0, 0.0, 0.0, 0.0}}, {"R", false, {10.0, 0.0, 0.0, 0.0, 0.0}}};
  frame.forces.resize(1);
  frame.forces[0].fy = 30.0;
  const result::FrameScales of_run = result::scales_of({frame}, 60.0),
                            of_frame = result::scales_of({frame}, 0.0);
  CHECK(of_run.greatest_force == 60.0);
  CHECK(of_frame.greatest_force == 30.0);
  CHECK(of_run.force_scale == doctest::Approx(0.5 * of_frame.force_scale));
  CHECK(result::scales_of(frame, of_run).force_scale == of_run.force_scale);
}

TEST_CASE("frames: one picture a frame, and --force clears them away") {
  const Folder folder;
  const Tip tip;
  {
    result::RunDirectory directory(folder / "run", tip.scene, tip.model);
    tip.feed(directory, 0.0, true);
    tip.feed(directory, 0.5, true);
    tip.feed(directory, 1.0, false);
    Report one = report();  // of one contact
    one.peaks.resize(1);
    one.audit.friction_work = {0.5};
    one.audit.friction.contact = 0;
    (void)directory.finish(one);
    const auto scripts = result::write_plots(folder / "run");
    std::string names;
    for (const auto& script : scripts) names += script.stem().string() + " ";
    CHECK(names == "displacement contact-foot states cone frame-1 frame-2 energy ");
  }
  result::RunDirectory again(folder / "run", tip.scene, tip.model, {true, {}});
  tip.feed(again, 0.0, false);
  CHECK_FALSE(std::filesystem::exists(folder / "run" / "frames.csv"));
  CHECK_FALSE(std::filesystem::exists(folder / "run" / "plots"));
}

TEST_CASE("frames: a label stands at the tail of its arrow, and its text ends inside the panel") {
  const Folder folder;
  const Tip tip;
  result::RunDirectory directory(folder / "run", tip.scene, tip.model);
  tip.feed(directory, 0.0, true);
  tip.feed(directory, 1.0, false);
  Report one = report();
  one.peaks.resize(1);
  one.audit.friction_work = {0.5};
  one.audit.friction.contact = 0;
  (void)directory.finish(one);
  const auto side = [&](double x, double nx, double ny) {
    spill(folder / "run" / "frame_contacts.csv",
          fmt::format(
              "t,contact,state,node,x,y,ux,uy,nx,ny,tx,ty,N,T\n0,foot,stick,R,{},0,0,0,{},{},{},{},-30,0\n",
              x, nx, ny, ny, -nx));
    (void)result::write_plots(folder / "run");
    const std::string script = slurp(folder / "run" / "plots" / "frame-1.gp");
    const std::size_t begin = script.find("set label 'foot: N = -30");
    REQUIRE(begin != std::string::npos);
    const std::string line = script.substr(begin, script.find(" offset ", begin) - begin);
    return line.substr(line.rfind(' ') + 1);
  };
  CHECK(side(4.0, 0.0, 1.0) == "right");  // from below, at the right end of the panel
  CHECK(side(2.0, 0.0, 1.0) == "center");
  CHECK(side(0.0, 0.0, 1.0) == "left");
  CHECK(side(2.0, 1.0, 0.0) == "right");  // pushed to the right: the tail lies to the left
  CHECK(side(2.0, -1.0, 0.0) == "left");
  CHECK(side(2.0, 0.6, 0.8) == "center");  // aslant is not sideways
}

TEST_SUITE_END();
