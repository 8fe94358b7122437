/* SPDX-License-Identifier: Apache-2.0 */
/* The C interface for programs that show Oriel's pictures: load a scene, edit it while it renders,
 * read the progressive picture, save.
 *
 * Link liboriel. All functions but oriel_session_open and oriel_session_close may be called from
 * any thread. No function throws or ends the process. A function that fails returns another value
 * than ORIEL_OK; oriel_last_error() then describes the problem. All texts are UTF-8.
 *
 * Structures start with their size. Set it by the oriel_init_ functions; the library reads and
 * writes no more than this size, so programs that were compiled with an older header keep working.
 *
 * Colours are scene-linear. Scenes are untrusted data: they load no native code unless
 * OrielSettings::shader_folders names a folder for it.
 */
#ifndef ORIEL_ORIEL_H
#define ORIEL_ORIEL_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define ORIEL_API __attribute__((visibility("default")))
#else
#define ORIEL_API
#endif

/* Increases when functions or fields are added. */
#define ORIEL_API_VERSION 1

typedef enum OrielResult {
  ORIEL_OK = 0,
  ORIEL_BAD_ARGUMENT = 1, /* a null pointer, a size of zero, a value out of range */
  ORIEL_NOT_FOUND = 2,    /* no such file, layer or camera */
  ORIEL_BAD_EDIT = 3,     /* the scene cannot take the edit; nothing was changed */
  ORIEL_NO_PICTURE = 4,   /* there is no picture yet */
  ORIEL_TIMEOUT = 5,
  ORIEL_FAILED = 6 /* any other problem, e.g. a file that cannot be written */
} OrielResult;

typedef struct OrielSession OrielSession; /* a scene and its renderer */
typedef struct OrielPicture OrielPicture; /* one consistent state of the picture */

typedef struct OrielSettings {
  size_t size;
  uint32_t seed;       /* random seed (0) */
  int32_t threads;     /* of the process, 0 = all cores (0) */
  int32_t frame;       /* render statement of the scene that is shown, from 1 (1) */
  float clamp;         /* maximum of a sample in pixel units, 0 = none (0) */
  const char* program; /* the oriel program, which converts models ("oriel", found by PATH) */
  const char* const* shader_folders; /* trusted folders of shader libraries (none) */
  size_t shader_folder_count;
  /* Called when a newer picture exists or the status has changed, from a thread of the renderer.
   * Must return at once and must not call the library. May be null. */
  void (*changed)(void* user);
  void* user;
} OrielSettings;

typedef struct OrielView {
  size_t size;
  int32_t has_look;            /* from, to and up replace the placement of the camera */
  float from[3], to[3], up[3]; /* world space */
  const char* camera;          /* instance; null = that of the render statement */
  int32_t width, height;       /* of the picture; 0 = from the camera */
  int32_t scale;               /* divides the size, 1 to 8 (1) */
  int32_t has_region;
  int32_t region[4];         /* x0 y0 x1 y1 from the upper left, ends excluded */
  uint32_t samples;          /* limit per pixel; 0 = from the scene */
  float noise;               /* limit of the relative noise; 0 = from the scene */
  double seconds;            /* limit of time; 0 = none */
  int32_t dragging;          /* pictures stay reduced while a pointer drags */
  const char* const* layers; /* additional layers, such as "normal" */
  size_t layer_count;
} OrielView;

typedef enum OrielState {
  ORIEL_STATE_LOADING = 0,
  ORIEL_STATE_PREPARING = 1,
  ORIEL_STATE_RENDERING = 2,
  ORIEL_STATE_CONVERGED = 3, /* the limits of the view are reached */
  ORIEL_STATE_FAILED = 4     /* the scene cannot be rendered; see the messages */
} OrielState;

typedef struct OrielStatus {
  size_t size;
  OrielState state;
  int32_t stopped; /* by oriel_session_stop, or not started yet */
  uint32_t epoch;  /* increases with each change of the scene or the view */
  double samples;  /* mean per pixel */
  double noise;    /* relative; negative = unknown */
  double done;     /* 0 to 1 */
  double elapsed;  /* seconds */
  double latency;  /* seconds from the last change to its first picture; negative = unknown */
} OrielStatus;

typedef struct OrielPictureInfo {
  size_t size;
  uint32_t epoch;
  uint64_t number;       /* increases with each picture of a session */
  int32_t preview;       /* a draft, mostly reduced, that another picture follows */
  int32_t divider;       /* the picture is reduced by this factor */
  int32_t width, height; /* of the whole picture, reduced */
  int32_t x, y, w, h;    /* the part with pixels, from the upper left */
  uint32_t samples;      /* per pixel, rounded down */
  size_t layer_count;
} OrielPictureInfo;

typedef enum OrielFormat {
  ORIEL_FORMAT_HALF_RGB = 0, /* three halves a pixel */
  ORIEL_FORMAT_FLOAT = 1     /* one float a pixel */
} OrielFormat;

typedef struct OrielLayer {
  size_t size;
  const char* name;
  OrielFormat format;
  const void* pixels; /* w x h pixels, rows from the top without padding */
  size_t bytes;
} OrielLayer;

typedef enum OrielSeverity {
  ORIEL_SEVERITY_NOTE = 0,
  ORIEL_SEVERITY_WARNING = 1,
  ORIEL_SEVERITY_ERROR = 2
} OrielSeverity;

/* ORIEL_API_VERSION of the library, and the version of Oriel. */
ORIEL_API uint32_t oriel_api_version(void);
ORIEL_API const char* oriel_version(void);

/* The problem of the last call of this thread that failed; valid until its next call. */
ORIEL_API const char* oriel_last_error(void);

/* Set size and defaults. */
ORIEL_API void oriel_init_settings(OrielSettings* settings);
ORIEL_API void oriel_init_view(OrielView* view);

/* Reads a scene (.mi) or a model (.glb, .fbx, .obj, .ifc ...; converted by OrielSettings::program
 * to a temporary scene with daylight). Rendering starts with oriel_session_start.
 * settings: null = defaults. */
ORIEL_API OrielResult oriel_session_open(const char* path, const OrielSettings* settings,
                                         OrielSession** session);
/* Ends the renderer. Pictures that were acquired stay valid. session may be null. */
ORIEL_API void oriel_session_close(OrielSession* session);

ORIEL_API OrielResult oriel_session_start(OrielSession* session);
/* Stops between passes, after the caches of indirect light if they are being computed;
 * oriel_session_start continues. */
ORIEL_API OrielResult oriel_session_stop(OrielSession* session);

/* Adds an edit ELEMENT.PARAMETER=VALUE, as `oriel render --set`; it replaces an earlier one of the
 * same parameter. epoch: that of the first picture with the edit; may be null. */
ORIEL_API OrielResult oriel_session_edit(OrielSession* session, const char* edit, uint32_t* epoch);
/* Replaces all edits. */
ORIEL_API OrielResult oriel_session_set_edits(OrielSession* session, const char* const* edits,
                                              size_t count, uint32_t* epoch);
ORIEL_API OrielResult oriel_session_set_view(OrielSession* session, const OrielView* view,
                                             uint32_t* epoch);

/* status->size must be set to sizeof(OrielStatus). */
ORIEL_API OrielResult oriel_session_status(OrielSession* session, OrielStatus* status);
/* Waits for a picture of that epoch or a later one with at least that many samples per pixel: 0 =
 * any picture, UINT32_MAX = the finished picture. Also returns when the picture is finished.
 * seconds: ORIEL_TIMEOUT afterwards; negative = no limit. ORIEL_FAILED if the scene cannot be
 * rendered. */
ORIEL_API OrielResult oriel_session_wait(OrielSession* session, uint32_t epoch, uint32_t samples,
                                         double seconds);

/* The newest picture; release it. */
ORIEL_API OrielResult oriel_picture_acquire(OrielSession* session, OrielPicture** picture);
ORIEL_API void oriel_picture_release(OrielPicture* picture);
/* info->size and layer->size must be set. */
ORIEL_API OrielResult oriel_picture_info(const OrielPicture* picture, OrielPictureInfo* info);
/* Layer 0 is "beauty": linear light before lens and output shaders. The pixels are valid until the
 * picture is released. */
ORIEL_API OrielResult oriel_picture_layer(const OrielPicture* picture, size_t index,
                                          OrielLayer* layer);
/* Copies a layer as floats, three a pixel for colours. count: elements of `to`. */
ORIEL_API OrielResult oriel_picture_read(const OrielPicture* picture, size_t index, float* to,
                                         size_t count);

/* Writes the present full-size picture as `oriel render -o` does; the suffix selects the type. */
ORIEL_API OrielResult oriel_session_save_picture(OrielSession* session, const char* path);
/* Writes the edits as a scene with a second frame that shows them; the scene's files stay. */
ORIEL_API OrielResult oriel_session_save_edits(OrielSession* session, const char* path);

/* Calls `message` with each message of the scene, on this thread. */
ORIEL_API OrielResult oriel_session_messages(OrielSession* session,
                                             void (*message)(void* user, OrielSeverity severity,
                                                             const char* code, const char* text),
                                             void* user);

#ifdef __cplusplus
}
#endif

#endif
