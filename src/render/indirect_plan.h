// SPDX-License-Identifier: Apache-2.0
// Which caches of indirect light a picture needs.
#pragma once

#include "scene/render_options.h"

namespace oriel {

/// The caches that are computed before the picture, and what paths follow without them.
struct IndirectPlan {
  bool gather = false, global = false, caustic = false;
  bool bounces = false;         ///< paths end at coarse records behind the first diffuse bounce
  bool by_name = false;         ///< a method was chosen by name, not by the scene's statements
  bool indirect = false;        ///< diffuse surfaces light each other, by rays or by caches
  bool sharp_caustics = false;  ///< photons for what paths hardly find; see SharpCaustics
  bool maps() const { return gather || global || caustic || bounces; }
  /// Name on the command line; "none" where diffuse surfaces get direct light only.
  const char* name() const;
};

/// The plan of the options: a method chosen by name, else the scene's statements. A method chosen
/// by name has caustics if `caustic` is on.
IndirectPlan plan_indirect(const scene::RenderOptions& options);

}  // namespace oriel
