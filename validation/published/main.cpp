// Published numbers beside ours, in Markdown: printed, closed form, and how far each engine is off it.
//
//   build/release/signorini_published                                  # prints the table
//   build/release/signorini_published validation/published/README.md   # ... into the page
#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "published/figure.hpp"

namespace {

using namespace signorini::published;

const std::string begin_mark = "<!-- table: begin -->\n", end_mark = "<!-- table: end -->";

std::string off(const Figure& figure, double ours) {
  if (!figure.compared) return "other law";
  if (!std::isfinite(ours)) return "another sequence";
  const double e = error(figure, ours);
  return e > 0.0 && e < std::numeric_limits<double>::epsilon() ? "rounding" : fmt::format("{:.1g}", e);
}

std::string printed(const Figure& figure) {
  const double digits = last_digits_off(figure);
  if (digits < 0.0) return "";
  return digits <= 1.0 ? figure.printed
                       : fmt::format("{}, **off by {:.2g} of its last digit**", figure.printed, digits);
}

std::string table() {
  std::string text =
      "| case | figure | printed | closed form | ida | exact | newmark | dt "
      "|\n|---|---|---|---|---|---|---|---|\n";
  for (const Case& c : all_cases()) {
    const std::vector<Figure> figures = c.figures();
    const auto ida = c.ours({"ida", c.dt}), exact = c.ours({"exact", c.dt}),
               newmark = c.ours({"newmark", c.dt});
    for (std::size_t i = 0; i < figures.size(); ++i)
      text += fmt::format("| {} | {} | {} | {:.15g} | {} | {} | {} | {} |\n", i == 0 ? c.name : "",
                          figures[i].what, printed(figures[i]), figures[i].exact, off(figures[i], ida.at(i)),
                          off(figures[i], exact.at(i)), off(figures[i], newmark.at(i)),
                          i == 0 ? fmt::format("{}", c.dt) : "");
  }
  return text;
}

void into_page(const std::string& path, const std::string& table) {
  std::stringstream page;
  page << std::ifstream(path).rdbuf();
  std::string text = page.str();
  const std::size_t begin = text.find(begin_mark), end = text.find(end_mark);
  if (begin == std::string::npos || end == std::string::npos)
    throw std::runtime_error(path + " has no marks");
  const std::size_t from = begin + begin_mark.size();
  text.replace(from, end - from, "\n" + table + "\n");
  if (!(std::ofstream(path) << text)) throw std::runtime_error("cannot write " + path);
}

}  // namespace

int main(int argc, char** argv) try {
  const auto start = std::chrono::steady_clock::now();
  const std::string text = table();
  if (argc > 1)
    into_page(argv[1], text);
  else
    fmt::print("{}", text);
  fmt::print(stderr, "{:.1f} s\n",
             std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
} catch (const std::exception& e) {
  std::cerr << e.what() << '\n';
  return 1;
}
