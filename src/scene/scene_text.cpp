#include "scene/scene_text.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "base/input_file.hpp"
#include "signorini/error.hpp"

namespace signorini {

std::string scene_text(const std::string& path) {
  constexpr std::size_t longest_file = 64u << 20;
  if (const std::string why = why_no_input_file(path); !why.empty())
    throw FileError(path, why + ", expected a scene file");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) throw FileError(path, std::strerror(errno ? errno : EIO));
  std::string text;
  std::array<char, 8192> block;
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(in.gcount()));
    if (text.size() > longest_file)
      throw SceneError({path, 0, 0}, "", "larger than 64 MB, expected a scene file");
  }
  if (in.bad()) throw FileError(path, "cannot be read");
  return text;
}

}  // namespace signorini
