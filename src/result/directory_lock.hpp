// directory_lock.hpp: one writer a directory.
//
//   DirectoryLock lock;   if (!lock.take("pipeline-run")) throw FileError(...);
//
// The lock is the system's (flock): it goes with the object and the processes it was handed to, killed or
// not.
#pragma once

#include <filesystem>

namespace signorini {

class DirectoryLock {
 public:
  DirectoryLock() = default;
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

  /// False where somebody else holds it. Some network file systems know no locks; there it is true. Errors:
  /// FileError where the directory cannot be opened.
  [[nodiscard]] bool take(const std::filesystem::path& directory);

 private:
  int descriptor_ = -1;
};

}  // namespace signorini
