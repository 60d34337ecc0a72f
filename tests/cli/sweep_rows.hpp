// sweep_rows.hpp: a sweep of the belt over five frictions, and its rows.
#pragma once

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "program.hpp"

namespace signorini::cli_test {

inline const std::string vary = "contacts.belt.friction.static=1:2:0.25";  // five rows

/// The rows without what differs from machine to machine.
[[nodiscard]] inline nlohmann::json rows(const Shell& shell, const std::string& directory) {
  nlohmann::json list = nlohmann::json::parse(shell.read(directory + "/results.json"))["rows"];
  for (nlohmann::json& row : list) row.erase("wall_time");
  return list;
}

/// The line of rows.jsonl that holds row n, from 1, with its end: the last of them; empty where none does.
[[nodiscard]] inline std::string line_of(const Shell& shell, const std::string& directory, int n) {
  if (!exists(shell, directory + "/rows.jsonl")) return "";
  std::istringstream rows(shell.read(directory + "/rows.jsonl"));
  std::string found;
  for (std::string line; std::getline(rows, line);)
    if (line.starts_with("{\"row\":" + std::to_string(n) + ",")) found = line + "\n";
  return found;
}

/// A block of 2 kg that slides at v on a floor, pressed by 10 N with friction 0.5: it stops after v^2 / 5.
inline const std::string sliding_block = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 4.0
engine = "exact"
output_dt = 4.0
initial = { block = { vx = 1.0 } }
[nodes]
block = [0.0, 0.0]
[[masses]]
node = "block"
mass = 2.0
[[supports]]
node = "block"
fix = ["uy"]
[[contacts]]
name = "floor"
node = "block"
law = "slider"
tangent = [1.0, 0.0]
normal_force = 10.0
friction = 0.5
[[output]]
name = "x"
kind = "displacement"
at = "block"
direction = [1.0, 0.0]
[[output]]
name = "v"
kind = "velocity"
at = "block"
direction = [1.0, 0.0]
)";

}  // namespace signorini::cli_test
