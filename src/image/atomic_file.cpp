// SPDX-License-Identifier: Apache-2.0
#include "image/atomic_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace oriel {

namespace fs = std::filesystem;

void write_atomically(const std::string& path,
                      const std::function<void(const std::string& temporary)>& write) {
  // The process id and the counter make the name unique across processes and threads.
  static std::atomic<unsigned> count{0};
  const fs::path target(path);
  const fs::path temporary =
      target.parent_path() / fmt::format(".{}.{}-{}{}", target.stem().string(), ::getpid(), count++,
                                         target.extension().string());

  std::error_code error;
  try {
    write(temporary.string());
  } catch (...) {
    fs::remove(temporary, error);
    throw;
  }
  fs::rename(temporary, target, error);
  if (error) {
    const std::string why = error.message();
    fs::remove(temporary, error);
    throw std::runtime_error("cannot write '" + path + "': " + why);
  }
}

}  // namespace oriel
