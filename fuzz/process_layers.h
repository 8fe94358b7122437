// SPDX-License-Identifier: Apache-2.0
// What commands do with the layers of an EXR file.
#pragma once

#include <stdexcept>
#include <vector>

#include "denoise/denoise.h"
#include "image/recombine.h"
#include "image/relight.h"

namespace oriel::fuzz {

/// Calls what throws std::runtime_error for input that it cannot use.
template <class F>
void attempt(const F& f) {
  try {
    f();
  } catch (const std::runtime_error&) {  // a message is what is asked for
  }
}

/// As the commands denoise and recombine. Large pictures are left out.
inline void process_layers(const std::vector<Layer>& layers) {
  for (const Layer& layer : layers)
    if (layer.image.pixel_count() > 1024) return;
  attempt([&] {
    DenoiseInput input = denoise_input(layers);
    for (const Layer* light : light_layers(layers)) input.parts.push_back(&light->image);
    denoise_with_parts(input);
  });
  const Layer* beauty = find_linear_beauty(layers);
  attempt([&] {
    const Recombination r = recombine(layers);
    compare_rebuilt(r.simple, beauty->image, 1e-4f);
    compare_rebuilt(r.complex, beauty->image, 1e-4f);
  });
  attempt([&] {
    std::vector<LightGain> gains;
    for (const std::string& name : light_layer_names(layers)) gains.push_back({name, tinted(2, 1)});
    relight(layers, gains);
  });
}

}  // namespace oriel::fuzz
