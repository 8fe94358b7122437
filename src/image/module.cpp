// SPDX-License-Identifier: Apache-2.0
#include "image/module.h"

#include <dlfcn.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <sstream>
#include <stdexcept>

namespace oriel {
namespace {

namespace fs = std::filesystem;

constexpr char kFileName[] = "liboriel_image_files.so";
std::atomic<FilesModule*> opened{nullptr};

FilesModule* open_module() {
  std::string tried;
  for (const std::string& candidate : module_candidates()) {
    std::error_code error;
    if (!fs::exists(candidate, error)) {
      tried += "\n  " + candidate + ": not there";
      continue;
    }
    // RTLD_LOCAL: symbols of the 260 dependent libraries must not resolve symbols of other code.
    void* handle = dlopen(candidate.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!handle) {
      const char* why = dlerror();
      tried += "\n  " + candidate + ": " + (why ? why : "cannot be loaded");
      continue;
    }
    const auto entry = reinterpret_cast<FilesModuleEntry>(dlsym(handle, kFilesModuleSymbol));
    if (FilesModule* module = entry ? entry(kFilesModuleVersion) : nullptr) return module;
    tried += "\n  " + candidate + ": belongs to another version of Oriel";
  }
  throw std::runtime_error(
      "the image files module was not found; set ORIEL_MODULE_PATH to the "
      "folder that holds it. Tried:" +
      tried);
}

}  // namespace

std::vector<std::string> module_candidates() {
  std::vector<std::string> out;
  const auto add = [&](const fs::path& folder) { out.push_back((folder / kFileName).string()); };
  if (const char* list = std::getenv("ORIEL_MODULE_PATH")) {
    std::istringstream folders(list);
    for (std::string folder; std::getline(folders, folder, ':');)
      if (!folder.empty()) add(folder);
  }
  const auto add_around = [&](const fs::path& object) {
    add(object.parent_path());
    add(object.parent_path().parent_path() / "lib" / "oriel");
  };
  std::error_code error;
  Dl_info self;
  if (dladdr(reinterpret_cast<const void*>(&files_module), &self) && self.dli_fname) {
    const fs::path object = fs::canonical(self.dli_fname, error);
    if (!error) add_around(object);
  }
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) add_around(program);
  add(ORIEL_MODULE_BUILD_FOLDER);
  return out;
}

FilesModule& files_module() {
  static std::mutex mutex;
  FilesModule* module = opened.load(std::memory_order_acquire);
  if (module) return *module;
  const std::lock_guard lock(mutex);
  if (!opened.load()) opened.store(open_module(), std::memory_order_release);
  return *opened.load();
}

bool image_module_is_open() { return opened.load(std::memory_order_acquire) != nullptr; }

}  // namespace oriel
