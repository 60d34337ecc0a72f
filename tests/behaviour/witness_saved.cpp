// A run that goes on from a state that lacks something is found out by the first run's contacts.csv.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/text.hpp"
#include "behaviour/witness_scenes.hpp"
#include "own_folder.hpp"
#include "result/run_directory.hpp"

using namespace signorini;
using namespace signorini::tests::witnessed;
using signorini::tests::OwnFolder;

TEST_SUITE_BEGIN("behaviour/witness_saved");

namespace {

/// The text of a table whose column holds this value in all rows but the heading's.
std::string altered_column(const std::string& text, const std::string& column, const std::string& value) {
  std::istringstream in(text);
  std::string result;
  std::ptrdiff_t at = -1;
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    if (at < 0)
      at = std::find(cells.begin(), cells.end(), column) - cells.begin();
    else
      cells.at(static_cast<std::size_t>(at)) = value;
    for (std::size_t i = 0; i < cells.size(); ++i) result += (i > 0 ? "," : "") + cells[i];
    result += "\n";
  }
  return result;
}

std::string text_of_file(const std::filesystem::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("planted faults: a saved state that lacks something, by the first run's contacts.csv") {
  struct Loss {
    const char *text, *column, *value;
  };
  const Loss losses[] = {{nullptr, "", ""},
                         {sliders_text, "sprung.T", "0.1"},
                         {feet_text, "left.T", "0.0"},
                         {feet_text, "right.slip", "0.0"},
                         {feet_text, "A.uy", "0.0"}};
  for (const Loss& loss : losses)
    for (const char* text : {sliders_text, feet_text})
      for (const Way& way : ways) {
        if (loss.text != nullptr && loss.text != text) continue;
        // A dashpot beside the spring of the right foot makes its sliding point an unknown, which modes do not follow.
        const bool sheared = text == feet_text && way.flow != Flow::modal;
        if (std::string_view(loss.column).ends_with(".slip") && !sheared) continue;
        std::vector<Override> changes;
        if (sheared) changes.push_back({"contacts.right.tangential_damping", "11.0"});
        CAPTURE(text);
        CAPTURE(loss.column);
        CAPTURE(to_string(way.engine));
        CAPTURE(static_cast<int>(way.flow));
        const OwnFolder own;
        const auto folder = own.path() / "first";
        const auto prepared = [&](Scene scene) {
          scene.run.engine = way.engine;
          scene.run.flow = way.flow;
          scene.run.certify = Certify::no;
          return scene;
        };
        const Scene first = prepared(parse_scene(text, "first.toml", changes));
        const Model model = build_model(first);
        {
          result::RunDirectory directory(folder, first, model, {true, {"test"}});
          static_cast<void>(directory.finish(simulate(model, first.run, directory)));
        }
        if (loss.text != nullptr) {
          std::filesystem::remove(
              folder / "manifest.json");  // a reader would notice the alteration before the witness
          const std::string states =
              altered_column(text_of_file(folder / "states.csv"), loss.column, loss.value);
          std::ofstream(folder / "states.csv") << states;
        }
        const double t = first.run.frames.front();
        changes.insert(changes.end(), {{"run.initial", "{ run = \"" + folder.string() +
                                                           "\", t = " + base::format_number(t) + " }"},
                                       {"run.t_end", "0.05"},
                                       {"run.frames", "[]"}});
        const Scene second = prepared(parse_scene(text, "second.toml", changes));
        const Model rest = build_model(second);
        REQUIRE(rest.saved_contacts.size() == rest.contacts.size());
        const Result run = simulate(rest, second.run);
        CHECK((run.report.law_checks.violated > 0) == (loss.text != nullptr));
        if (loss.text == nullptr) tell(run.report.law_checks);
      }
}

TEST_SUITE_END();
