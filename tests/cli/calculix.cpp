// models/calculix: matrices that CalculiX has stored, and the script that takes them.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "program.hpp"

using nlohmann::json;
using signorini::cli_test::Shell;

TEST_SUITE_BEGIN("cli/calculix");

TEST_CASE("cli calculix: the strip has the frequencies that CalculiX computes from the same elements") {
  const Shell shell;
  const json facts = json::parse(shell.run({"check", SIGNORINI_MODELS "/calculix/strip.toml", "--json"}).out);
  CHECK(facts["degrees_of_freedom"] == 96);
  // ccx 2.20, *FREQUENCY with 4 modes: rad/s, with the seven digits of strip.dat
  const std::vector<double> printed = {284.1849, 1847.847, 5577.759, 8569.606};
  for (std::size_t i = 0; i < printed.size(); ++i)
    CHECK(std::abs(facts["frequencies"]["open"]["modes"][i]["omega"].get<double>() - printed[i]) <
          1e-6 * printed[i]);
}

TEST_CASE("cli calculix: take.sh turns the upper triangle round, leaves zeros out and names what moves") {
  const Shell shell;
  shell.write("job.sti", "1 1  2.0e+02\n1 2 -1.0e+02\n2 2  1.0e+02\n1 3  0.0e+00\n3 3  5.0e+00\n");
  shell.write("job.mas", "1 1  1.0e+00\n2 2  1.0e+00\n3 3  2.0e+00\n");
  shell.write("job.dof", "5.1\n5.2\n12.3\n");
  const std::string line =
      "cd '" + (shell / "").string() + "' && bash '" SIGNORINI_MODELS "/calculix/take.sh' job >names";
  REQUIRE(std::system(line.c_str()) == 0);
  CHECK(shell.read("names") == "dofs = [\"n5x\", \"n5y\", \"n12z\"]\n");
  CHECK(shell.read("job.K.mtx") ==
        "%%MatrixMarket matrix coordinate real symmetric\n3 3 4\n1 1 2.0e+02\n2 1 -1.0e+02\n2 2 1.0e+02\n3 3 "
        "5.0e+00\n");
  CHECK(shell.read("job.M.mtx").find("3 3 3\n") != std::string::npos);
}

TEST_SUITE_END();
