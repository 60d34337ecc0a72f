#include "base/input_file.hpp"

#include <system_error>

namespace signorini {

namespace fs = std::filesystem;

std::string why_no_input_file(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (!fs::exists(status) || fs::is_regular_file(status)) return "";
  if (fs::is_directory(status)) return "is a directory";
  if (fs::is_fifo(status)) return "is a pipe";
  if (fs::is_socket(status)) return "is a socket";
  return "is a device";
}

std::string because(int error) { return error == 0 ? "" : ": " + std::generic_category().message(error); }

}  // namespace signorini
