// SPDX-License-Identifier: Apache-2.0
// Rendering options and camera: miOptions and miCamera.
#ifndef ORIEL_SDK_OPTIONS_H
#define ORIEL_SDK_OPTIONS_H

#include "enums.h"
#include "types.h"

/// The options element. Read only; lengths in scene units.
typedef struct miOptions {
  miBoolean trace;  ///< rays are traced
  int scanline;     ///< miRENDER_FH_*
  miUint motion;    ///< motion blur bits, 0 = none
  int reflection_depth, refraction_depth, trace_depth;
  int min_samples, max_samples;  ///< levels: 4^n samples per pixel
  miColor contrast, time_contrast;
  miBoolean caustic, globillum;
  int caustic_accuracy, globillum_accuracy, photonvol_accuracy;  ///< photons per lookup
  float caustic_radius, globillum_radius, photonvol_radius;      ///< 0 = default of the renderer
  float caustic_filter_const, filter_size_x, filter_size_y, jitter;  ///< sizes in pixels
  float shutter, shutter_delay;
  int no_images;      ///< number of frame buffers, including the miRC_IMAGE_USER standard ones
  miTag images_info;  ///< their list
  int finalgather;    ///< 0 off, 1 on, 'f' fast lookup
  int finalgather_rays;
  float finalgather_maxradius, finalgather_minradius;
  miCBoolean finalgather_view;  ///< radii are in pixels
  miUchar finalgather_filter;
  miUint1 fg_reflection_depth, fg_refraction_depth, fg_trace_depth, fg_diffuse_depth;
  float fg_falloff_start, fg_falloff_stop;
  miColor caustic_scale, globillum_scale, finalgather_scale, finalgather_sec_scale;
  miColor photonvol_scale;
  char shadow;  ///< 0 off, 1 on, 'l' sorted, 's' segmented
  char face;    ///< 'f' front, 'b' back, 'a' all
  char filter, acceleration, field, smethod;
  char render_space;  ///< 'c' camera, 'o' object, 'm' mixed
  char use_shadow_maps;
  miCBoolean visible_lights;
  int photon_reflection_depth, photon_refraction_depth, photon_trace_depth;
  miCBoolean no_lens, no_volume, no_geometry, no_displace, no_output, no_merge, no_hair, no_pass;
  miCBoolean autovolume, photon_autovolume, photonmap_only;
  miCBoolean desaturate, dither, nopremult;
  miUchar colorclip;
  float gamma;
  miColor luminance_weight;  ///< weights of mi_luminance
  float maxdisplace;
  miTag userdata;
  miTag string_options;  ///< named options, see mi::shader::Options
  miBoolean irradiance_particles;
} miOptions;

typedef miOptions miRc_options;

/// The camera element. Read only. It looks along -z with y up; raster (0,0) is the lower left.
typedef struct miCamera {
  miBoolean orthographic;
  float focal;     ///< distance of the film
  float aperture;  ///< width of the film; at distance focal, half the visible width is aperture / 2
  float aspect;    ///< width / height
  miRange clip;    ///< depth range, scene units
  int x_resolution, y_resolution;
  struct {
    int xl, yl, xh, yh;
  } window;  ///< pixels that are rendered
  miTag volume, environment, lens, output, pass;
  int frame;
  float frame_time;
  int frame_field;
  float x_offset, y_offset;  ///< pixels
  miTag userdata;
  miTag buffertag;      ///< named frame buffers, see mi::shader::Access_fb
  float focus, radius;  ///< depth of field of the rasterizer
} miCamera;

#endif
