// vtu_array.hpp: reads back what was written for ParaView.
#pragma once

#include <doctest/doctest.h>

#include <sstream>
#include <string>
#include <vector>

namespace signorini::test {

/// The numbers of an array of a file for ParaView.
[[nodiscard]] inline std::vector<double> array_of(const std::string& text, const std::string& name) {
  const std::size_t at = text.find("Name=\"" + name + "\"");
  REQUIRE(at != std::string::npos);
  const std::size_t begin = text.find(">\n", at) + 2;
  std::istringstream stream(text.substr(begin, text.find("</DataArray>", begin) - begin));
  std::vector<double> values;
  for (double value = 0.0; stream >> value;) values.push_back(value);
  return values;
}

}  // namespace signorini::test
