#include <doctest/doctest.h>

#include "result/csv.hpp"
#include "result/picture_files.hpp"
#include "result/plot_parts.hpp"
#include "result/plots.hpp"
#include "result/run_directory.hpp"
#include "signorini/error.hpp"
#include "unit/result/made_up.hpp"

using namespace signorini;
using namespace signorini::made_up;

namespace {

/// A run in folder/run with output times 0 and 1, and these events between them.
void write_run(const Folder& folder, const Model& model, const std::vector<Event>& events = {}) {
  result::RunDirectory directory(folder / "run", scene(), model);
  feed(directory, 0.0);
  for (const Event& event : events) directory.event(event);
  feed(directory, 1.0);
  (void)directory.finish(report());
}

}  // namespace

TEST_SUITE_BEGIN("unit/result/plots");

TEST_CASE("plots: nothing in a name is expanded by gnuplot") {
  CHECK(result::quoted("it's `rm`") == "'it''s `rm`'");
  CHECK(result::quoted("two\nlines") == "'two lines'");
  CHECK(result::quoted("'tis a title") == "'\u2019tis a title'");
  CHECK(result::quoted("end'") == "'end'''");
  CHECK(result::quoted("6'' on a plate") == R"('6'."\047\047".' on a plate')");
  CHECK(result::quoted("'''") == R"(''."\047\047\047".'')");
  CHECK(result::named_tics('x', {{"%s of 100 %", 0}, {"it's", 3}}) ==
        "set xtics ('%%s of 100 %%' 0, 'it''s' 3)");
}

TEST_CASE("plots: a row a contact is as high as a picture allows, and names do not overlap") {
  const result::PictureStyle screen;
  CHECK(result::row_height(34.0, 3, screen) == 34.0);
  for (const std::size_t count : {800UL, 1000UL, 5000UL}) {
    const double row = result::row_height(34.0, count, screen);
    const double dots =
        1.5 * (row * static_cast<double>(count) + result::margin_above + result::margin_below);
    CHECK(dots <= 32767.0);  // Cairo's limit
    CHECK(dots >= 20000.0);
    const std::string ticks = result::row_tics(std::vector<result::RunFacts::Contact>(count), row);
    CHECK(static_cast<double>(std::count(ticks.begin(), ticks.end(), ',')) * 13.0 <
          row * static_cast<double>(count));
  }
  result::PictureStyle paper;
  paper.width = 400.0;
  CHECK(result::row_height(34.0, 1000, paper) < result::row_height(34.0, 1000, screen));
}

TEST_CASE("plots: scripts, and bands that are exact to the event") {
  const Folder folder;
  write_run(folder, model(), {slip(0.123456789)});

  const auto scripts = result::write_plots(folder / "run");
  REQUIRE(scripts.size() == 7);
  CHECK(scripts[1].filename() == "contact-foot.gp");
  CHECK(scripts[2].filename() == "contact-pad__left.gp");
  const auto plots = folder / "run" / "plots";
  CHECK(slurp(plots / "states-foot.csv") == "from,to,state\n0.123456789,1,slip-\n0,0.123456789,stick\n");
  CHECK(scripts[4].filename() == "raster.gp");
  CHECK(scripts[5].filename() == "cone.gp");
  CHECK(slurp(plots / "marks.csv") == "row,t,event,N,T\n0,0.123456789,slip,-58.86,-17.658\n");
  CHECK(slurp(plots / "states-pad__left.csv") == "from,to,state\n0,1,slip-\n");
}

TEST_CASE("plots: a curve reads the rows that it draws") {
  result::PlottedRun run = result::empty_plotted_run("", {"N", "kg", "m", "s"});
  run.slugs = {"a", "b"};
  run.bands = {{{0.0, 1.0, "stick"}, {1.0, 2.0, "slip+"}, {2.0, 3.0, "stick"}, {3.0, 4.0, "open"}},
               {{0.0, 4.0, "stick"}}};
  CHECK(result::band_table(run.bands[0]) == "from,to,state\n3,4,open\n1,2,slip+\n0,1,stick\n2,3,stick\n");
  const auto rows = [&](std::size_t k, const std::string& state) {
    return result::band_curve(run, k, state, 2.0, 3.0, 1.0).value().rows;
  };
  CHECK(rows(0, "open") == "'states-a.csv' skip 1 every ::0::0");
  CHECK(rows(0, "slip+") == "'states-a.csv' skip 1 every ::1::1");
  CHECK(rows(0, "stick") == "'states-a.csv' skip 1 every ::2::3");
  CHECK(rows(1, "stick") == "'states-b.csv' skip 1 every ::0::0");
  CHECK_FALSE(result::band_curve(run, 1, "open", 0.0, 1.0, 1.0));
  CHECK(result::band_curve(run, 0, "stick", 2.0, 3.0, 1.0)->columns == "1:(2.5):1:2:(2):(3)");
}

TEST_CASE("plots: marks stand by type and contact, whatever the order of events") {
  const Folder folder;
  const auto event = [](double t, int contact, EventType type, State from, State to) {
    Event e = slip(t);
    e.contact = contact;
    e.type = type;
    e.from = from;
    e.to = to;
    return e;
  };
  write_run(folder, model(),
            {event(0.1, 1, EventType::stick, State::slip_minus, State::stick),
             event(0.2, 0, EventType::slip, State::stick, State::slip_minus),
             event(0.3, 1, EventType::slip, State::stick, State::slip_minus),
             event(0.4, 0, EventType::stick, State::slip_minus, State::stick),
             event(0.5, 0, EventType::slip, State::stick, State::slip_minus)});
  const result::PlottedRun run = result::read_plotted_run(result::TableFolder(folder / "run"),
                                                          result::read_run_facts(folder / "run"), {});
  std::vector<std::pair<int, double>> order;
  for (const result::Mark& mark : run.marks) order.emplace_back(mark.row, mark.t);
  CHECK(order == std::vector<std::pair<int, double>>{{0, 0.2}, {0, 0.5}, {1, 0.3}, {0, 0.4}, {1, 0.1}});
  const auto rows = [&](const char* type, std::optional<int> row = std::nullopt) {
    const result::PlottedRun::Rows found = result::marks_of(run, type, row);
    return std::pair(found.first, found.count);
  };
  CHECK(rows("slip") == std::pair<std::size_t, std::size_t>(0, 3));
  CHECK(rows("slip", 0) == std::pair<std::size_t, std::size_t>(0, 2));
  CHECK(rows("slip", 1) == std::pair<std::size_t, std::size_t>(2, 1));
  CHECK(rows("stick", 1) == std::pair<std::size_t, std::size_t>(4, 1));
  CHECK(rows("impact").second == 0);
  // Each panel of the cone draws its own, each lane of the raster those of its type.
  (void)result::write_plots(folder / "run");
  const std::string cone = slurp(folder / "run" / "plots" / "cone.gp"),
                    raster = slurp(folder / "run" / "plots" / "raster.gp");
  for (const char* of_panel : {"::0::1", "::2::2", "::3::3", "::4::4"})
    CHECK(cone.find(std::string("'marks.csv' skip 1 every ") + of_panel + " using (-$4):5 with points") !=
          std::string::npos);
  CHECK(raster.find("'marks.csv' skip 1 every ::0::2 using 2:($1 + ") != std::string::npos);
  CHECK(raster.find("'marks.csv' skip 1 every ::3::4 using 2:($1 + ") != std::string::npos);
}

TEST_CASE("plots: a picture is its panels, from above, each with its axes and curves") {
  const result::PlottedRun run = result::empty_plotted_run("A portal", {"N", "kg", "m", "s"});
  result::Picture picture{"two", "Twice", result::canvas_of({}, 400.0, false), false};
  picture.panels.push_back(
      {"upper [m]", {{"'a.csv'", "1:2", "with lines", "it's"}, {"'b.csv'", "1:3", "with points"}}});
  picture.panels.push_back(
      {"lower [N]", {{"3*x", "", "with lines"}}, "set logscale y\n", 2.0, "unset logscale y\n"});
  const std::string script = result::script_of(run, picture);
  const auto at = [&](const std::string& text) {
    const std::size_t place = script.find(text);
    CAPTURE(text);
    CHECK(place != std::string::npos);
    return place;
  };
  const std::string upper =
      "plot 'a.csv' using 1:2 with lines title 'it''s', \\\n     'b.csv' using 1:3 with points notitle\n";
  CHECK(at("set ylabel 'upper [m]'") < at(upper));
  CHECK(at(upper) < at("set ylabel 'lower [N]'"));
  CHECK(at("set ylabel 'lower [N]'") < at("set logscale y\nplot 3*x with lines notitle\n"));
  CHECK(at("notitle\nunset label 1\nunset label 2\nunset logscale y\n") > 0);
  // Only the lowest one has figures at its horizontal axis.
  CHECK(at("unset xlabel") < at(upper));
  CHECK(at("set xlabel 'time t [s]'") > at(upper));
  const auto edges = result::panel_edges({1.0, 2.0}, picture.canvas, picture.space);
  CHECK(2.0 * (edges[0].top - edges[0].bottom) == doctest::Approx(edges[1].top - edges[1].bottom));
  // 400 less 62, 70 and 22 for what is above, below and between, a third of it.
  CHECK(400.0 * (edges[0].top - edges[0].bottom) == doctest::Approx(246.0 / 3.0));
}

TEST_CASE("plots: what earlier pictures left goes only where new ones come") {
  const Folder folder;
  const auto ours = [](const std::filesystem::path& file) { return file.stem() == "old"; };
  std::filesystem::create_directories(folder / "run" / "plots");
  result::write_file(folder / "run" / "plots" / "old.gp", "plot 1\n");
  result::write_file(folder / "run" / "plots" / "mine.txt", "kept\n");
  result::PictureFiles files(ours);
  files.add_table("numbers", "a\n1\n");
  files.add({}, result::Picture{});
  CHECK(files.write(folder / "run").empty());
  CHECK(slurp(folder / "run" / "plots" / "old.gp") == "plot 1\n");
  result::Picture picture{"new", "", result::canvas_of({}, 400.0, false), false};
  picture.panels.push_back({"", {{"x", "", "with lines"}}});
  files.add({}, picture);
  const auto scripts = files.write(folder / "run");
  REQUIRE(scripts.size() == 1);
  CHECK(scripts[0].filename() == "new.gp");
  CHECK_FALSE(std::filesystem::exists(folder / "run" / "plots" / "old.gp"));
  CHECK(slurp(folder / "run" / "plots" / "mine.txt") == "kept\n");
  CHECK(slurp(folder / "run" / "plots" / "numbers.csv") == "a\n1\n");
}

TEST_CASE("plots: names that look alike as file names stay apart") {
  const Folder folder;
  Model m = model();
  m.contacts[0].name = "a/b";
  m.contacts[1].name = "a.b";
  write_run(folder, m);
  const auto scripts = result::write_plots(folder / "run");
  CHECK(scripts[1].filename() == "contact-a_b.gp");
  CHECK(scripts[2].filename() == "contact-a_b-2.gp");
}

TEST_CASE("plots: the close-up of one contact is not the picture of another") {
  for (const bool other_first : {false, true}) {
    const Folder folder;
    Model m = model();
    m.contacts[0].name = other_first ? "a-events" : "a";
    m.contacts[1].name = other_first ? "a" : "a-events";
    write_run(folder, m);
    const auto scripts = result::write_plots(folder / "run");
    CHECK(scripts[1].filename() == (other_first ? "contact-a-events.gp" : "contact-a.gp"));
    CHECK(scripts[2].filename() == (other_first ? "contact-a-2.gp" : "contact-a-events-2.gp"));
  }
}

TEST_CASE("plots: a legend has room for its names") {
  CHECK(result::legend_width({"ida", "exact"}) == result::Canvas::usual_legend);
  const std::string name = "friction-iteration:dt=1e-3";
  // 9 points a letter, and the line in front of it.
  CHECK(result::legend_width({"ida", name}) >= 8.5 * static_cast<double>(name.size()) + 50.0);
  CHECK(result::legend_name(name) == name);
  const std::string longer = std::string(100, 'a') + std::string(100, 'b');
  CHECK(result::legend_name(longer).size() <= 44);
  CHECK(result::legend_name(longer).find("a...b") != std::string::npos);
  CHECK(result::canvas_of({}, 800.0, true).right(result::legend_width({longer})) >= 0.5);
  std::string umlauts;
  for (int i = 0; i < 60; ++i) umlauts += "\u00e4";
  CHECK(result::legend_name(umlauts).find("\u00e4...\u00e4") != std::string::npos);
  CHECK(result::legend_name("x" + umlauts).find("\u00e4...\u00e4") != std::string::npos);
}

TEST_CASE("plots: the axis of a curve that hardly moves is no picture of rounding") {
  const auto range = [](double least, double greatest) {
    result::Range r;
    r.take(least);
    r.take(greatest);
    return r;
  };
  // A pipe on its shoes: 7e-5 m with noise in the sixteenth digit. One per cent to each side; by hand.
  CHECK(result::constant_axis(range(-8e-5, -8e-5 * (1.0 + 1e-15)), 2e-3) ==
        "set yrange [-8.08e-05:-7.92e-05]\n");
  CHECK(result::constant_axis(range(8.0, 8.0), 8.0) == "set yrange [7.92:8.08]\n");
  // What is rounding beside its like is zero: a thousandth of that to each side.
  CHECK(result::constant_axis(range(-1e-19, 1.4e-19), 2.0) == "set yrange [-0.002:0.002]\n");
  CHECK(result::is_rounding(range(-1e-19, 1.4e-19), 2e-3));
  CHECK_FALSE(result::is_rounding(range(0.0, 1e-9), 2e-3));
  // A small motion is none, nor what six digits can tell apart.
  CHECK(result::constant_axis(range(0.0, 1e-9), 2e-3).empty());
  CHECK(result::constant_axis(range(1.0, 1.001), 2.0).empty());
  CHECK(result::constant_axis(result::Range{}, 1.0).empty());
  CHECK(result::constant_axis(range(0.0, 0.0), 0.0).empty());
}

TEST_CASE("plots: on paper letters stay readable, and take their room") {
  result::PictureStyle look;
  CHECK(result::canvas_of(look, 800.0, true).width == 1120.0);
  for (const double mm : {85.0, 120.0, 160.0, 240.0}) {
    CAPTURE(mm);
    look.width = mm;
    const result::Canvas canvas = result::canvas_of(look, 800.0, true);
    CHECK(canvas.width * canvas.pixel * 25.4 / 96.0 == doctest::Approx(mm));
    CHECK(canvas.font(13.0) * 72.0 / 96.0 >= 6.0 - 1e-12);                         // points
    CHECK((canvas.right() - canvas.left()) * canvas.width >= 0.5 * canvas.width);  // left for the curves
    CHECK(canvas.height * canvas.pixel >= 800.0 * mm / 1120.0 * 96.0 / 25.4 * 0.25);
    CHECK(result::panel_edges({1.0, 1.0}, canvas, 20.0).back().bottom * canvas.height ==
          doctest::Approx(result::margin_below));
  }
  look.width = 160.0;
  look.height = 90.0;
  const result::Canvas flat = result::canvas_of(look, 1000.0, true);
  CHECK(flat.height * flat.pixel * 25.4 / 96.0 == doctest::Approx(90.0));
  CHECK(flat.height >= 500.0 - 1e-9);
}

TEST_CASE("plots: a contact without friction has neither T nor slip, and no part in the cones") {
  const Folder folder;
  Model m = model();
  m.contacts[0].friction = {};
  write_run(folder, m);
  (void)result::write_plots(folder / "run");
  const auto plots = folder / "run" / "plots";
  const std::string smooth = slurp(plots / "contact-foot.gp"), rough = slurp(plots / "contact-pad__left.gp");
  CHECK(smooth.find("'T [") == std::string::npos);
  CHECK(smooth.find("slip p") == std::string::npos);
  CHECK(rough.find("'T [") != std::string::npos);
  CHECK(rough.find("slip p") != std::string::npos);
}

TEST_CASE("plots: a run of one instant has no pictures, a folder without a run is an error") {
  const Folder folder;
  const Scene s = scene();
  const Model m = model();
  result::RunDirectory directory(folder / "run", s, m);
  feed(directory, 0.0);
  CHECK(result::write_plots(folder / "run").empty());
  CHECK_THROWS_AS((void)result::write_plots(folder / "elsewhere"), FileError);
}

TEST_SUITE_END();
