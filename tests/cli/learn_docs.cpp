// The commands of docs/tutorial.md, one after the other, in a folder with models/.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "program.hpp"

using namespace signorini::cli_test;

namespace {

std::string doc(const std::string& name) {
  std::ifstream file(std::string(SIGNORINI_MODELS "/../docs/") + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> words_of_command(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word; words.push_back(word)) std::erase(word, '\'');  // as a shell does
  return words;
}

}  // namespace

TEST_SUITE_BEGIN("cli/tutorial");

TEST_CASE("cli tutorial: every command runs, and what the text says comes out") {
  const Shell shell;
  std::filesystem::create_directory_symlink(SIGNORINI_MODELS, shell / "models");
  std::istringstream lines(doc("tutorial.md"));
  int commands = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("    signorini ")) continue;
    std::vector<std::string> words = words_of_command(line);
    words.erase(words.begin());
    const bool draws =
        words[0] == "run" || words[0] == "compare" || words[0] == "sweep" || words[0] == "verify";
    if (draws) words.emplace_back("--no-plots");
    const bool needs_gnuplot = words[0] == "plot" && std::system("command -v gnuplot >/dev/null 2>&1") != 0;
    if (needs_gnuplot) continue;
    CAPTURE(line);
    const Ending ending = shell.run(words);
    CAPTURE(ending.err);
    CHECK(ending.code == 0);
    ++commands;
  }
  CHECK(commands >= 15);

  const std::string block = shell.read("block-run/events.csv"), rough = shell.read("rough/events.csv");
  CHECK(has(block, "\n0.5,plate,slip,stick,slip+"));
  CHECK(has(block, ",plate,stick,slip+,stick"));
  CHECK_FALSE(has(rough, ",slip,"));
  CHECK(has(shell.read("smooth/events.csv"), ",slip,"));
  for (const char* event : {"slip", "separation", "contact", "stick"})
    CHECK(has(shell.read("portal-run/events.csv"), std::string(",footing,") + event + ","));
  CHECK(has(shell.read("certified/events.csv"), ",t_error,certain\n"));
  CHECK(has(shell.read("pipe-sweep/sweep.csv"), "\n3,0.5,done,"));
  CHECK(exists(shell, "pipeline/paraview/run.pvd"));
}

TEST_CASE("cli docs: the commands of command-line.md, one after the other, have directories of their own") {
  std::istringstream lines(doc("command-line.md"));
  std::set<std::string> taken;
  int commands = 0;
  bool synopsis = true;
  for (std::string line; std::getline(lines, line);) {
    synopsis = synopsis && !line.starts_with("## ");
    if (synopsis || !line.starts_with("    signorini ")) continue;
    for (std::string more; line.back() == '\\' && std::getline(lines, more);)
      line = line.substr(0, line.size() - 1) + more;
    const std::vector<std::string> words = words_of_command(line);
    const std::string& command = words.at(1);
    const bool of_runs = command == "compare" && !words.at(2).starts_with("models/");
    if (words.size() < 3 || (!words[2].starts_with("models/") && !of_runs)) continue;
    CAPTURE(line);
    for (std::size_t i = 2; of_runs && i < words.size() && !words[i].starts_with("-"); ++i)
      CHECK(taken.count(words[i]) == 1);
    const auto named = std::find(words.begin(), words.end(), "-o");
    const std::string folder =
        named != words.end() ? *(named + 1) : std::filesystem::path(words[2]).stem().string() + "-" + command;
    CHECK(taken.insert(folder).second);
    ++commands;
  }
  CHECK(commands >= 14);
}

TEST_CASE("cli tutorial: pages of docs name files and headings that are there") {
  for (const std::string page :
       {"tutorial.md", "what-to-do.md", "coming-from.md", "editors.md", "python.md"}) {
    const std::string text = doc(page);
    REQUIRE_FALSE(text.empty());
    for (std::size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 1)) {
      const std::string target = text.substr(at + 2, text.find_first_of(")#", at) - at - 2);
      if (target.empty() || target.starts_with("http")) continue;
      CAPTURE(page);
      CAPTURE(target);
      CHECK(std::filesystem::exists(std::string(SIGNORINI_MODELS "/../docs/") + target));
    }
  }
}

TEST_SUITE_END();
