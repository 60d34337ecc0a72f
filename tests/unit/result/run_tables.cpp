#include <doctest/doctest.h>
#include <sys/stat.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "result/csv.hpp"
#include "result/run_tables.hpp"
#include "signorini/error.hpp"
#include "unit/result/made_up.hpp"

using namespace signorini;
using namespace signorini::made_up;

TEST_SUITE_BEGIN("unit/result/run_tables");

TEST_CASE("csv: numbers read back exactly") {
  const Folder folder;
  const std::vector<double> numbers = {0.0,
                                       0.1,
                                       1.0 / 3.0,
                                       -1.9390000000000001e-3,
                                       6.02214076e23,
                                       1e-310,
                                       std::numeric_limits<double>::max(),
                                       std::nextafter(1.0, 2.0)};
  {
    result::CsvFile file(folder / "numbers.csv");
    result::CsvBlock block;
    block.text("x").end_row();
    for (const double x : numbers) block.number(x).end_row();
    file.write(block);
  }
  result::CsvReader reader(folder / "numbers.csv");
  for (const double x : numbers) {
    REQUIRE(reader.next());
    CHECK(reader.number(0) == x);
    CHECK(std::signbit(reader.number(0)) == std::signbit(x));
  }
  CHECK_FALSE(reader.next());
}

TEST_CASE("csv: the shortest digits that do") {
  result::CsvBlock block;
  block.number(0.1).number(1e6).number(-0.3).number(std::optional<double>{}).end_row();
  CHECK(block.str() == "0.1,1e+06,-0.3,\n");
}

TEST_CASE("csv: names with commas, quotes and line breaks survive") {
  const Folder folder;
  {
    result::CsvFile file(folder / "names.csv");
    result::CsvBlock block;
    block.text("name").text("other").end_row();
    block.text("pad, \"left\"\nor so").text("plain").end_row();
    file.write(block);
  }
  result::CsvReader reader(folder / "names.csv");
  REQUIRE(reader.next());
  CHECK(reader.cell(0) == "pad, \"left\"\nor so");
  CHECK(reader.cell(1) == "plain");
}

TEST_CASE("csv: every block is on disk when write returns") {
  const Folder folder;
  result::CsvFile file(folder / "a.csv");
  result::CsvBlock block;
  block.text("t").end_row();
  file.write(block);
  CHECK(slurp(folder / "a.csv") == "t\n");
  block.number(1.5).end_row();
  file.write(block);
  CHECK(slurp(folder / "a.csv") == "t\n1.5\n");
}

TEST_CASE("csv: a row cut short by a kill is left out when reading") {
  const Folder folder;
  spill(folder / "a.csv", "t,x\n1,2\n3,4");
  result::CsvReader reader(folder / "a.csv");
  CHECK(reader.next());
  CHECK_FALSE(reader.next());
}

TEST_CASE("csv: a full disk is an error with the file's name") {
  if (!std::filesystem::exists("/dev/full")) return;
  result::CsvFile file("/dev/full");
  result::CsvBlock block;
  block.text("t").end_row();
  try {
    file.write(block);
    FAIL("no error");
  } catch (const FileError& error) {
    CHECK(error.code() == ExitCode::file);
    CHECK(std::string(error.what()).find("/dev/full: cannot be written: No space left") == 0);
  }
}

TEST_CASE("csv: a file that cannot be created is an error") {
  const Folder folder;
  CHECK_THROWS_AS(result::CsvFile(folder / "no" / "such.csv"), FileError);
}

TEST_CASE("events.csv: header, gaps of sliders, impulses, load jumps") {
  const Folder folder;
  const Model m = model();
  {
    result::TableFile<Event> table(folder / "events.csv", result::event_table(m));
    table.add(slip(0.125));
    Event pad = slip(0.25);
    pad.contact = 1;
    pad.gap.reset();
    pad.impulse_n = 2.5;
    pad.guard_rate = -4.0;
    pad.t_uncertainty = 1e-9;
    table.add(pad);
    Event load;
    load.t = 0.5;
    table.add(load);
    table.flush();
  }
  CHECK(slurp(folder / "events.csv") ==
        "t,contact,event,from,to,gap,N,T,N_after,T_after,vn,vn_after,vt,vt_after,impulse_n,impulse_t,"
        "guard_rate,t_uncertainty\n"
        "0.125,foot,slip,stick,slip-,0,-58.86,-17.658,-58.86,-17.658,0,0,0,0,,,,\n"
        "0.25,\"pad, left\",slip,stick,slip-,,-58.86,-17.658,-58.86,-17.658,0,0,0,0,2.5,,-4,1e-09\n"
        "0.5,,time,,,,,,,,,,,,,,,\n");
}

TEST_CASE("history.csv, contacts.csv, energy.csv: headers and rows") {
  const Folder folder;
  const Model m = model();
  struct Tables : Recorder {
    Tables(const Folder& f, const Model& model_of)
        : model(model_of),
          history(f / "history.csv", result::history_table(model_of)),
          contacts(f / "contacts.csv", result::contact_table()),
          energy(f / "energy.csv", result::energy_table()) {}
    void event(const Event&) override {}
    void sample(const Sample& s) override {
      history.add(s);
      for (std::size_t k = 0; k < s.contacts.size(); ++k)
        contacts.add({s.t, model.contacts[k], s.contacts[k]});
      energy.add(s);
    }
    const Model& model;
    result::TableFile<Sample> history;
    result::TableFile<result::ContactRow> contacts;
    result::TableFile<Sample> energy;
  } tables(folder, m);
  feed(tables, 0.001);
  tables.history.flush();
  tables.contacts.flush();
  tables.energy.flush();
  CHECK(slurp(folder / "history.csv") == "t,A.ux,A.uy,A.vx,A.vy\n0.001,0.25,-0.5,1,0\n");
  CHECK(slurp(folder / "contacts.csv") ==
        "t,contact,state,gap,ut,vt,slip,N,T,ratio\n"
        "0.001,foot,stick,0.001,0.25,0,0,-58.86,3,0.05096839959225281\n"
        "0.001,\"pad, left\",slip-,,0.25,1,0.25,-1,-0.3,0.3\n");
  CHECK(slurp(folder / "energy.csv") ==
        "t,kinetic,elastic,contact,damping,friction,impact,loads,surface,balance\n"
        "0.001,0.5,0,0,0,0,0,0,0,0.5\n");
}

TEST_CASE("contacts.csv: ratio is empty where a contact is open, has no friction, or N = 0") {
  const Model m = model();
  Contact smooth = m.contacts[0];
  smooth.friction = {};
  const ContactSample stuck{State::stick, 0.0, 0.0, 0.0, 0.0, -8.0, -3.0}, open{State::open, 0.5},
      inside{State::inside, -0.5}, unloaded{State::stick, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0},
      closed{State::closed, 0.0, 0.0, 0.0, 0.0, -8.0, 0.0};
  const std::vector<result::ContactRow> rows = {
      {0.0, m.contacts[0], stuck},    {0.0, m.contacts[0], open},     {0.0, m.contacts[0], inside},
      {0.0, m.contacts[0], unloaded}, {0.0, m.contacts[1], unloaded}, {0.0, smooth, closed}};
  std::istringstream lines(result::contact_table().text(rows));
  std::vector<std::string> ratios;
  for (std::string line; std::getline(lines, line);) ratios.push_back(line.substr(line.rfind(',') + 1));
  CHECK(ratios == std::vector<std::string>{"ratio", "0.375", "", "", "", "", ""});
}

TEST_CASE("tables: columns by name, cells of every kind, numbers for gnuplot") {
  struct Row {
    std::string name;
    std::optional<long> count;
    double x;
  };
  result::CsvTable<Row> table = {{"name", &Row::name}, {"count", &Row::count}};
  table.add("twice", [](const Row& row) { return 2.0 * row.x; });
  table.add_put("both", [](result::CsvBlock& block, const Row& row) { block.text(row.name + "!"); });
  CHECK(table.text(std::vector<Row>{{"a, b", 3, 0.25}, {"c", std::nullopt, -1.0}}) ==
        "name,count,twice,both\n\"a, b\",3,0.5,\"a, b!\"\nc,,-2,c!\n");
  CHECK(table.number("twice") == 3);
  CHECK(table.value("count") == "$2");
  CHECK(table.word("name") == "strcol(1)");
  CHECK_THROWS_AS((void)table.number("thrice"), std::logic_error);
  // Pictures read both files of contacts by these places.
  CHECK(result::contact_table().number("N") == 8);
}

TEST_CASE("files: a link that stands where the draft goes is not followed") {
  const Folder folder;
  spill(folder / "precious", "mine");
  std::filesystem::create_symlink(folder / "precious", folder / "a.json.part");
  result::write_file(folder / "a.json", "ours");
  CHECK(slurp(folder / "precious") == "mine");
  CHECK(slurp(folder / "a.json") == "ours");
}

TEST_CASE("csv: what is no file is not waited for") {
  const Folder folder;
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK_THROWS_WITH_AS(result::CsvReader(folder / "pipe"), doctest::Contains("is a pipe, expected a file"),
                       FileError);
  CHECK_THROWS_WITH_AS(result::CsvReader(folder / ""), doctest::Contains("is a directory"), FileError);
}

// Negative zero is a number of the machine, none of mechanics.
TEST_CASE("tables and JSON have no negative zero") {
  result::CsvBlock block;
  block.number(-0.0).number(-1e-300).end_row();
  CHECK(block.str() == "0,-1e-300\n");
  const base::Json numbers = {{"a", -0.0}, {"b", {1, -0.0, -2.5}}, {"c", {{"d", -0.0}}}};
  CHECK(base::json_line(numbers) == R"({"a":0.0,"b":[1,0.0,-2.5],"c":{"d":0.0}})");
  CHECK(base::json_text(base::Json{{"n", -3}}).find("-3") != std::string::npos);
}

TEST_SUITE_END();
