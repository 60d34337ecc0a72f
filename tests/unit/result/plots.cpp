#include <doctest/doctest.h>

#include "result/plot_parts.hpp"
#include "result/plots.hpp"
#include "result/run_directory.hpp"
#include "signorini/error.hpp"
#include "unit/result/made_up.hpp"

using namespace signorini;
using namespace signorini::made_up;

TEST_SUITE_BEGIN("unit/result/plots");

TEST_CASE("plots: nothing in a name is expanded by gnuplot") {
  CHECK(quoted("it's `rm`") == "'it''s `rm`'");
  CHECK(quoted("two\nlines") == "'two lines'");
  CHECK(quoted("'tis a title") == "'\u2019tis a title'");
  CHECK(quoted("end'") == "'end'''");
  CHECK(quoted_tick("%s of 100 %") == "'%%s of 100 %%'");
}

TEST_CASE("plots: scripts, and bands that are exact to the event") {
  const Folder folder;
  const Scene s = scene();
  const Model m = model();
  RunDirectory directory(folder / "run", s, m);
  feed(directory, 0.0);
  directory.event(slip(0.123456789));
  feed(directory, 1.0);
  (void)directory.finish(report());

  const auto scripts = write_plots(folder / "run");
  REQUIRE(scripts.size() == 7);
  CHECK(scripts[1].filename() == "contact-foot.gp");
  CHECK(scripts[2].filename() == "contact-pad__left.gp");
  const auto plots = folder / "run" / "plots";
  CHECK(slurp(plots / "states-foot.csv") == "from,to,state\n0,0.123456789,stick\n0.123456789,1,slip-\n");
  CHECK(scripts[4].filename() == "raster.gp");
  CHECK(scripts[5].filename() == "cone.gp");
  CHECK(slurp(plots / "marks.csv") == "row,t,event,N,T\n0,0.123456789,slip,-58.86,-17.658\n");
  CHECK(slurp(plots / "states-pad__left.csv") == "from,to,state\n0,1,slip-\n");
}

TEST_CASE("plots: names that look alike as file names stay apart") {
  const Folder folder;
  const Scene s = scene();
  Model m = model();
  m.contacts[0].name = "a/b";
  m.contacts[1].name = "a.b";
  RunDirectory directory(folder / "run", s, m);
  feed(directory, 0.0);
  feed(directory, 1.0);
  (void)directory.finish(report());
  const auto scripts = write_plots(folder / "run");
  CHECK(scripts[1].filename() == "contact-a_b.gp");
  CHECK(scripts[2].filename() == "contact-a_b-2.gp");
}

TEST_CASE("plots: a legend has room for its names") {
  CHECK(room_for({"ida", "exact"}) == panel_right);
  const std::string name = "friction-iteration:dt=1e-3";
  // 9 points a letter, and the line in front of it.
  CHECK((1.0 - room_for({"ida", name})) * picture_width >= 8.5 * static_cast<double>(name.size()) + 50.0);
  CHECK(legend_name(name) == name);
  const std::string longer = std::string(100, 'a') + std::string(100, 'b');
  CHECK(legend_name(longer).size() <= 44);
  CHECK(legend_name(longer).find("a...b") != std::string::npos);
  CHECK(room_for({longer}) > 0.5);
  std::string umlauts;
  for (int i = 0; i < 60; ++i) umlauts += "\u00e4";
  CHECK(legend_name(umlauts).find("\u00e4...\u00e4") != std::string::npos);
  CHECK(legend_name("x" + umlauts).find("\u00e4...\u00e4") != std::string::npos);
}

TEST_CASE("plots: a run of one instant has no pictures, a folder without a run is an error") {
  const Folder folder;
  const Scene s = scene();
  const Model m = model();
  RunDirectory directory(folder / "run", s, m);
  feed(directory, 0.0);
  CHECK(write_plots(folder / "run").empty());
  CHECK_THROWS_AS((void)write_plots(folder / "elsewhere"), FileError);
}

TEST_SUITE_END();
