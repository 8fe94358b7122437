// SPDX-License-Identifier: Apache-2.0
// The shader interface for C and C++, at the level of mental ray 3.6.
#ifndef ORIEL_SDK_SHADER_H
#define ORIEL_SDK_SHADER_H

// Conventions
//   Spaces, units and the meaning of miFALSE are documented at the top of each header below.
//   Priorities and permitted callers: functions.txt beside this file.

#include "mi_shader_if.h"
#include "shader/blackbody.h"
#include "shader/brdf.h"
#include "shader/call.h"
#include "shader/connection.h"
#include "shader/database.h"
#include "shader/direction.h"
#include "shader/enums.h"
#include "shader/eval.h"
#include "shader/image.h"
#include "shader/image_tools.h"
#include "shader/info.h"
#include "shader/irradiance.h"
#include "shader/kdtree.h"
#include "shader/light.h"
#include "shader/lookup.h"
#include "shader/memory_blocks.h"
#include "shader/options.h"
#include "shader/output.h"
#include "shader/parameter_set.h"
#include "shader/photon.h"
#include "shader/probe.h"
#include "shader/query.h"
#include "shader/renderpass.h"
#include "shader/sample.h"
#include "shader/scene.h"
#include "shader/space.h"
#include "shader/spectrum.h"
#include "shader/state.h"
#include "shader/system.h"
#include "shader/texture.h"
#include "shader/texture_x.h"
#include "shader/trace.h"
#include "shader/types.h"
#include "shader/vector.h"
#include "shader/volume.h"

#endif
