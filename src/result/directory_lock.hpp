// directory_lock.hpp: one writer per directory.
//
//   DirectoryLock lock;   if (!lock.take("pipeline-run")) throw FileError(...);
//
// The lock is the system's (flock): it ends with the object and with the processes that inherited it, even if they are
// killed.
#pragma once

#include <filesystem>

namespace signorini {

class DirectoryLock {
 public:
  DirectoryLock() = default;
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

  /// Returns false if another process holds the lock. Some network file systems have no locks; there it is true.
  /// Errors: FileError if the directory cannot be opened.
  [[nodiscard]] bool take(const std::filesystem::path& directory);

 private:
  int descriptor_ = -1;
};

}  // namespace signorini
