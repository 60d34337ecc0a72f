// Strong-motion records as public collections have them, and tables as spreadsheets write them.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <fstream>
#include <sstream>

#include "own_folder.hpp"
#include "scene/history_from_spec.hpp"
#include "scene/time_table.hpp"
#include "signorini/error.hpp"
#include "signorini/scene.hpp"

namespace signorini::tests::strong_motion {
namespace {

using scene::RecordQuantity;
using scene::TableLayout;
using scene::TimeTable;

TableLayout wanting(RecordQuantity quantity, double time_step = 0.0) {
  TableLayout layout;
  layout.wanted = quantity;
  layout.time_step = time_step;
  return layout;
}

TableLayout values_only() { return wanting(RecordQuantity::none, 0.1); }

TimeTable read(const std::string& text, const TableLayout& layout) {
  std::istringstream in(text);
  return scene::read_time_table(in, "file", "key", layout);
}

/// Message of the refusal; "none" if the text is read.
std::string refusal(const std::string& text, const TableLayout& layout) {
  try {
    (void)read(text, layout);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "none";
}

bool begins(const std::string& text, const std::string& with) { return text.starts_with(with); }
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string peer(const std::string& unit_line) {
  return "PEER STRONG MOTION DATABASE RECORD\nA STATION, 180\n" + unit_line +
         "\nNPTS=   4, DT= .0100 SEC\n  .1E+00 -.2E+00\n  .3E+00  .4E+00\n";
}

/// Blocks of one channel, the numbers in columns of `width` characters without blanks between them.
std::string csmip(double factor) {
  std::string text = "Corrected accelerogram\n4 points of instrument-corrected data\n -999 -999\n";
  for (const char* quantity : {"accel", "veloc", "displ"}) {
    const char* unit = quantity[0] == 'a' ? "cm/sec2" : quantity[0] == 'v' ? "cm/sec" : "cm";
    text +=
        fmt::format("   4 points of {} data equally spaced at  .020 sec, in {}. (3f9.3)\n", quantity, unit);
    factor *= -2.0;
    text += fmt::format("{:9.3f}{:9.3f}{:9.3f}\n{:9.3f}\n", -1000.125 * factor, -2000.5 * factor,
                        -300.25 * factor, factor);
  }
  return text + "/&  ---------- End of data for channel  1 ----------\n";
}

/// A scene whose support moves, or whose ground shakes, as `file` says.
std::string scene_of(const std::string& table) {
  return "schema = 1\nunits = { force = \"kN\", mass = \"kg\", length = \"mm\", time = \"ms\" }\n"
         "[run]\nt_end = 1.0\n[nodes]\nA = [0.0, 0.0]\nB = [1.0, 0.0]\n[[masses]]\nnode = \"A\"\nmass = 1.0\n"
         "[[springs]]\nnode = \"A\"\nagainst = \"B\"\ndirection = [1.0, 0.0]\nstiffness = 1.0\n" +
         table;
}

}  // namespace

TEST_SUITE_BEGIN("unit/scene/strong_motion");

TEST_CASE("words behind the unit of a PEER record, as in 230 of 238 files of a public collection") {
  const TableLayout acceleration = wanting(RecordQuantity::acceleration);
  for (const char* unit :
       {"G. FILTER POINTS: HP=0.2 Hz LP=15.0 Hz", "G", "(g)", "g, filtered", "G  DAMPING 5%"}) {
    CAPTURE(unit);
    const TimeTable table =
        read(peer("ACCELERATION TIME HISTORY IN UNITS OF " + std::string(unit)), acceleration);
    CHECK(table.unit.value().si == 9.80665);
    CHECK(table.values == std::vector<double>{0.1, -0.2, 0.3, 0.4});
    CHECK(table.times == std::vector<double>{0.0, 0.01, 0.02, 0.03});
  }
  CHECK(read(peer("The units are (g)"), acceleration).unit.value().si == 9.80665);
  CHECK(read(peer("ACCELERATION IN UNITS OF CM / SEC**2. FILTER"), acceleration).unit.value().si == 0.01);
}

TEST_CASE("the step of a record is read whole, or the heading is refused") {
  const auto record = [](const std::string& points_line) {
    return "PEER NGA\nKobe\nACCELERATION TIME SERIES IN UNITS OF G\n" + points_line +
           "\n.1 .2 -.3 .4 .5 .6\n";
  };
  const TableLayout layout = wanting(RecordQuantity::acceleration);
  for (const char* step : {"2.0D-02 SEC", "2.0E-02", ".02SEC", "0.02 s", ".02, SECONDS"}) {
    CAPTURE(std::string(step));
    const TimeTable table = read(record(std::string("NPTS=  6, DT=  ") + step), layout);
    CHECK(table.times.back() == doctest::Approx(0.1).epsilon(1e-14));
  }
  for (const char* line :
       {"NPTS= 6, DT= 20 MSEC", "NPTS= 6, DT= 20 ms", "NPTS= 6, DT= 20 MIN", "NPTS= 6, DT= 1/50",
        "NPTS= 6, DT= 0.02/0.01", "NPTS= 6, DT= 0.02.5", "NPTS= 6,000, DT= 0.02", "NPTS= 6 7, DT= 0.02"}) {
    CAPTURE(std::string(line));
    CHECK(refusal(record(line), layout) != "none");
  }
  const TimeTable older = read(
      "PEER\nKobe\nACCELERATION TIME HISTORY IN UNITS OF G\n  6   0.0200   NPTS, DT\n.1 .2 -.3 .4 .5 .6\n",
      layout);
  CHECK(older.times.back() == doctest::Approx(0.1).epsilon(1e-14));
}

TEST_CASE("a record is of the quantity that its heading names, whatever unit it names") {
  const TableLayout acceleration = wanting(RecordQuantity::acceleration),
                    velocity = wanting(RecordQuantity::velocity),
                    displacement = wanting(RecordQuantity::displacement);
  const std::string wrong = peer("VELOCITY TIME HISTORY IN UNITS OF G");
  for (const TableLayout& layout : {acceleration, velocity, displacement})
    CHECK(begins(refusal(wrong, layout),
                 "file:3: key: found \"VELOCITY TIME HISTORY IN UNITS OF G\", expected"));
  CHECK(read(peer("VELOCITY TIME SERIES IN UNITS OF CM/S"), velocity).unit.value().name == "cm/s");
  CHECK(read(peer("DISPLACEMENT TIME SERIES IN UNITS OF CM"), displacement).unit.value().si == 0.01);
  CHECK(has(refusal(peer("DISPLACEMENT TIME SERIES IN UNITS OF CM"), acceleration),
            "expected an acceleration"));
  CHECK(
      has(refusal(peer("ACCELERATION TIME SERIES IN UNITS OF G"), displacement), "expected a displacement"));
  // A title is not the quantity.
  CHECK(refusal("VELOCITY LAB\n" + peer("ACCELERATION IN UNITS OF G").substr(5), acceleration) == "none");
  // A key without records.
  CHECK(has(refusal(peer("ACCELERATION IN UNITS OF G"), {}), "found a PEER record of acceleration"));
}

TEST_CASE("a unit that is not known is given by the scene") {
  TableLayout layout = wanting(RecordQuantity::acceleration);
  const std::string text = peer("ACCELERATION IN UNITS OF FURLONGS");
  CHECK(has(refusal(text, layout), "give the unit in the scene, for example unit = \"g\""));
  layout.unit_given = true;
  CHECK_FALSE(read(text, layout).unit);
  CHECK_FALSE(read(peer("no unit"), layout).unit);
}

TEST_CASE("a record's time step may be repeated in the scene, not changed") {
  const std::string text = peer("ACCELERATION IN UNITS OF G");
  CHECK(read(text, wanting(RecordQuantity::acceleration, 0.01)).times.back() == 0.03);
  CHECK(begins(refusal(text, wanting(RecordQuantity::acceleration, 0.02)),
               "file:4: key: found a time step of 0.01 s"));
}

TEST_CASE("blocks of CSMIP: the quantity that the key takes, in columns without blanks") {
  const TimeTable a = read(csmip(1.0), wanting(RecordQuantity::acceleration)),
                  v = read(csmip(1.0), wanting(RecordQuantity::velocity)),
                  d = read(csmip(0.01), wanting(RecordQuantity::displacement));
  CHECK(a.values == std::vector<double>{2000.25, 4001.0, 600.5, -2.0});
  CHECK(a.times == std::vector<double>{0.0, 0.02, 0.04, 0.06});
  CHECK(a.unit.value().si == 0.01);
  CHECK(v.values.at(0) == -4000.5);
  CHECK(v.unit.value().name == "cm/s");
  CHECK(d.values.at(3) == -0.08);
  CHECK(d.unit.value().name == "cm");
  CHECK(has(refusal(csmip(1.0) + csmip(1.0), wanting(RecordQuantity::acceleration)),
            "found a second channel of acceleration, after that of line 4"));
  CHECK(has(refusal(csmip(1.0), {}), "only accelerations, motions and velocities take records"));
  std::string cut = csmip(1.0);
  cut.replace(cut.find("-2.000"), 6, "      ");
  CHECK(has(refusal(cut, wanting(RecordQuantity::acceleration)),
            "found 3 values, expected 4, the number in line 4"));
  std::string wrong = csmip(1.0);
  wrong.replace(wrong.find(" 4001.000"), 9, " 40.1.000");
  CHECK(begins(refusal(wrong, wanting(RecordQuantity::acceleration)), "file:5:11: key: found \"40.1.000\""));
}

TEST_CASE("a COSMOS record needs its time step") {
  const std::string text =
      "Corrected acceleration\n 0 Comment line(s) follow, each starting with a \"|\":\n"
      "   3 acceleration pts, approx   1 secs, units=cm/s^2 (4),Format=(10F8.5)\n-0.00003-0.00004 0.00002\n"
      "End-of-data for Chan  1 acceleration\n";
  const TimeTable table = read(text, wanting(RecordQuantity::acceleration, 0.005));
  CHECK(table.values == std::vector<double>{-0.00003, -0.00004, 0.00002});
  CHECK(table.times == std::vector<double>{0.0, 0.005, 0.01});
  CHECK(has(refusal(text, wanting(RecordQuantity::acceleration)), "expected time_step in the scene"));
}

TEST_CASE("comments and semicolons in tables") {
  const std::string comments = "% made up\n! by hand\n// once\n  # more\nt;x\n";
  const TimeTable table = read(comments + "0.0;1.0 # first\n0.5 ; 2.0\n\n1.0\t3.0 % last\n", {});
  CHECK(table.times == std::vector<double>{0.0, 0.5, 1.0});
  CHECK(table.values == std::vector<double>{1.0, 2.0, 3.0});
  CHECK(read("# v\n1;2;3\n4 ! four\n", values_only()).values == std::vector<double>{1.0, 2.0, 3.0, 4.0});
  CHECK(has(refusal("a b\nc d\n0 1\n", {}), "other lines of text begin with #"));
  CHECK(has(refusal("0\n1\n2\n", {}), "for a file of values only give time_step"));
  CHECK(has(refusal("0 1 2\n1 2 3\n", {}), "give column for a file of several columns"));
}

TEST_CASE("decimal commas are refused with line and column where a comma could separate two numbers") {
  const std::string german = "0,15\n0,30\n-0,20\n0,10\n";
  CHECK(begins(refusal(german, values_only()),
               "file:1:1: key: found \"0,15\", one number with a decimal comma"));
  CHECK(begins(refusal("x\n  1;-0,5e-3\n", values_only()), "file:2:5: key: found \"-0,5e-3\""));
  CHECK(begins(refusal("0,0;1,5\n0,1;2,5\n", {}), "file:1:1: key: found \"0,0\""));
  CHECK(begins(refusal("0\t1,5\n1\t2,5\n", {}), "file:1:3: key: found \"1,5\""));
  TableLayout third;
  third.column = 3;
  CHECK(begins(refusal("0,0;1,5;2,5\n1,0;2,5;3,5\n2,0;2,5;3,5\n", third), "file:1:1: key: found \"0,0\""));
  // Commas that can only separate.
  CHECK(read("0.5,1\n2,3\n", values_only()).values == std::vector<double>{0.5, 1.0, 2.0, 3.0});
  CHECK(read("0,-1\n2,3\n", values_only()).values == std::vector<double>{0.0, -1.0, 2.0, 3.0});
  CHECK(read("1,2\n3, 4\n", values_only()).values == std::vector<double>{1.0, 2.0, 3.0, 4.0});
  CHECK(read("1,2,3\n4,5\n", values_only()).values.size() == 5);
  CHECK(read("0,1\n1,2\n", {}).values == std::vector<double>{1.0, 2.0});
}

TEST_CASE("records as motion of a support and as velocity of a surface, in the scene's units") {
  const OwnFolder own;
  const auto file = [&](const char* name, const std::string& text) {
    std::ofstream(own.path() / name) << text;
    return (own.path() / name).string();
  };
  const std::string dt2 = file("record.dt2", peer("DISPLACEMENT TIME SERIES IN UNITS OF CM")),
                    vt2 = file("record.vt2", peer("VELOCITY TIME SERIES IN UNITS OF CM/S")),
                    text = file("record.txt", peer("ACCELERATION TIME SERIES IN UNITS OF G"));
  const auto support = [&](const std::string& key, const std::string& path, const std::string& more) {
    return parse_scene(scene_of("[[supports]]\nnode = \"B\"\nfix = [\"ux\"]\n" + key +
                                " = { type = \"table\", file = \"" + path + "\"" + more + " }\n"),
                       "test.toml");
  };
  const auto message = [&](const std::string& key, const std::string& path, const std::string& more) {
    try {
      (void)support(key, path, more);
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  const HistorySpec moved = support("motion", dt2, "").supports.at(0).motion.value();
  CHECK(moved.times == std::vector<double>{0.0, 10.0, 20.0, 30.0});
  CHECK(moved.values.at(1) == doctest::Approx(-2.0).epsilon(1e-15));  // -0.2 cm
  const HistorySpec shaken = support("acceleration", text, "").supports.at(0).motion.value();
  CHECK(shaken.values.at(3) == doctest::Approx(0.4 * 9.80665e-3).epsilon(1e-15));
  CHECK(has(message("motion", vt2, ""), "expected a displacement in units of CM"));
  CHECK(has(message("motion", text, ""), "expected a displacement"));
  CHECK(has(message("acceleration", dt2, ""), "expected an acceleration"));
  // The unit of a file that states none.
  const std::string plain = file("plain.txt", "0.5\n1.5\n");
  const HistorySpec in_cm = support("motion", plain, ", time_step = 1.0, unit = \"cm\", offset = 2.0")
                                .supports.at(0)
                                .motion.value();
  const History f = scene::make_history(in_cm, "f");
  CHECK(f.value(0.5) == doctest::Approx((1.0 + 2.0) * 10.0).epsilon(1e-14));
  CHECK(has(message("motion", plain, ", time_step = 1.0, unit = \"g\""), "expected a unit of displacement"));
  CHECK(has(message("motion", dt2, ", unit = \"mm\""), "the file gives its values in cm"));
  // run.toml is the same scene.
  const Scene scene = support("motion", dt2, ", unit = \"cm\"");
  const HistorySpec again = parse_scene(scene.resolved, "run.toml").supports.at(0).motion.value();
  CHECK(scene::make_history(again, "f").value(10.0) ==
        scene::make_history(scene.supports.at(0).motion.value(), "f").value(10.0));
  CHECK(scene::make_history(again, "f").value(10.0) == doctest::Approx(-2.0).epsilon(1e-15));
}

TEST_SUITE_END();

}  // namespace signorini::tests::strong_motion
