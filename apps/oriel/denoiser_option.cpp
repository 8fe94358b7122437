// SPDX-License-Identifier: Apache-2.0
#include "denoiser_option.h"

#include "suggest.h"

namespace oriel::app {

void add_denoiser_option(CLI::App& app, std::string& name) {
  app.add_option("--denoiser", name,
                 "Denoiser: oriel (same bytes on every machine), oidn (Open Image Denoise, whose "
                 "library must be on this machine) or auto (default: oidn if it is there)")
      ->check(one_of({"auto", "oriel", "oidn"}));
}

Denoiser denoiser_of(const std::string& name) {
  if (name == "oriel") return Denoiser::Own;
  return name == "oidn" ? Denoiser::Oidn : Denoiser::Best;
}

}  // namespace oriel::app
