// SPDX-License-Identifier: Apache-2.0
// The functions of include/oriel/oriel.h that act on sessions.
#include <algorithm>
#include <cstring>

#include "embed/embed_picture.h"
#include "embed/embed_session.h"
#include "embed/guard.h"
#include "interactive/interactive_session.h"
#include "interactive/render_loop.h"
#include "interactive/save_edits.h"
#include "output/camera_output.h"
#include "output/output.h"
#include "output/picture_metadata.h"

using namespace oriel;
using embed::EmbedError;
using embed::EmbedSession;
using embed::guarded;
using embed::required;
using interactive::RenderLoop;
using interactive::TaskKind;

struct OrielSession {
  EmbedSession session;
};

namespace oriel::embed {
namespace {

EmbedSession& session_of(OrielSession* handle) { return required(handle, "session").session; }

void store_epoch(std::uint32_t epoch, std::uint32_t* to) {
  if (to) *to = epoch;
}

/// The fields that a program of an older version has; the others have their defaults.
template <class T>
T known_fields(const T* from, void (*init)(T*), const char* name) {
  T settings;
  init(&settings);
  if (!from) return settings;
  if (from->size < sizeof(std::size_t))
    throw EmbedError(ORIEL_BAD_ARGUMENT, std::string(name) + ": size is not set");
  std::memcpy(&settings, from, std::min(from->size, sizeof(T)));
  return settings;
}

std::vector<std::string> layers_of(const OrielView& view) {
  std::vector<std::string> layers = {interactive::kBeautyLayer};
  if (view.layer_count > 0) required(view.layers, "layers");
  for (std::size_t i = 0; i < view.layer_count; ++i) {
    const std::string name = &required(view.layers[i], "layers");
    if (std::find(layers.begin(), layers.end(), name) == layers.end()) layers.push_back(name);
  }
  return layers;
}

interactive::ViewSettings view_settings(const OrielView& view) {
  interactive::ViewSettings settings;
  const auto vector = [](const float* v) { return Vec3(v[0], v[1], v[2]); };
  if (view.has_look) {
    settings.look = {vector(view.from), vector(view.to), vector(view.up)};
    if (!interactive::camera_matrix(*settings.look))
      throw EmbedError(ORIEL_BAD_ARGUMENT, "from, to and up do not define a camera");
  }
  if (view.camera) settings.camera = view.camera;
  constexpr int kMostPixels = 1 << 16;
  const bool sized = view.width != 0 || view.height != 0;
  if (sized &&
      (view.width < 1 || view.height < 1 || view.width > kMostPixels || view.height > kMostPixels))
    throw EmbedError(ORIEL_BAD_ARGUMENT, "width or height is out of range");
  if (sized) settings.size = {view.width, view.height};
  settings.scale = view.scale;
  if (view.has_region)
    settings.region = {view.region[0], view.region[1], view.region[2], view.region[3]};
  settings.layers = layers_of(view);
  if (view.samples > 0) settings.budget.samples = view.samples;
  if (view.noise > 0) settings.budget.noise = view.noise;
  if (view.seconds > 0) settings.budget.seconds = view.seconds;
  settings.dragging = view.dragging != 0;
  return settings;
}

std::uint32_t set_edits(EmbedSession& session, std::vector<std::string> edits) {
  return session.run(TaskKind::Changes, [&](RenderLoop& loop) {
    loop.set_edits(edits);
    return loop.next_epoch();
  });
}

void save_picture(RenderLoop& loop, const std::string& path) {
  const RenderSession* session = loop.session();
  if (!session || session->film().mean_samples() < 1)
    throw EmbedError(ORIEL_NO_PICTURE, "there is no full-size picture yet");
  PictureFile file = picture_file(path);
  file.shaders = loop.scene().output_shaders();
  for (const std::string& name : loop.view().layers) file.layers |= LayerSet(name);
  write_picture(file, *session, picture_metadata(session->world(), file.shaders));
}

}  // namespace
}  // namespace oriel::embed

extern "C" {

uint32_t oriel_api_version(void) { return ORIEL_API_VERSION; }
const char* oriel_version(void) { return ORIEL_VERSION; }

void oriel_init_settings(OrielSettings* settings) {
  if (!settings) return;
  *settings = {};
  settings->size = sizeof(OrielSettings);
  settings->frame = 1;
}

void oriel_init_view(OrielView* view) {
  if (!view) return;
  *view = {};
  view->size = sizeof(OrielView);
  view->scale = 1;
}

OrielResult oriel_session_open(const char* path, const OrielSettings* settings,
                               OrielSession** session) {
  return guarded([&] {
    required(session, "session") = nullptr;
    const std::string file = &required(path, "path");
    *session =
        new OrielSession{{file, embed::known_fields(settings, &oriel_init_settings, "settings")}};
  });
}

void oriel_session_close(OrielSession* session) { delete session; }

OrielResult oriel_session_start(OrielSession* session) {
  return guarded([&] { embed::session_of(session).set_stopped(false); });
}

OrielResult oriel_session_stop(OrielSession* session) {
  return guarded([&] { embed::session_of(session).set_stopped(true); });
}

OrielResult oriel_session_edit(OrielSession* session, const char* edit, uint32_t* epoch) {
  return guarded([&] {
    const std::string text = &required(edit, "edit");
    const std::uint32_t next =
        embed::session_of(session).run(TaskKind::Changes, [&](RenderLoop& loop) {
          loop.set_edits(
              interactive::with_edit(loop.scene().scene(), loop.scene().edited().edits(), text));
          return loop.next_epoch();
        });
    embed::store_epoch(next, epoch);
  });
}

OrielResult oriel_session_set_edits(OrielSession* session, const char* const* edits, size_t count,
                                    uint32_t* epoch) {
  return guarded([&] {
    std::vector<std::string> list;
    if (count > 0) required(edits, "edits");
    for (std::size_t i = 0; i < count; ++i) list.emplace_back(&required(edits[i], "edits"));
    embed::store_epoch(embed::set_edits(embed::session_of(session), std::move(list)), epoch);
  });
}

OrielResult oriel_session_set_view(OrielSession* session, const OrielView* view, uint32_t* epoch) {
  return guarded([&] {
    const auto settings = embed::view_settings(
        embed::known_fields(&required(view, "view"), &oriel_init_view, "view"));
    const std::uint32_t next =
        embed::session_of(session).run(TaskKind::Changes, [&](RenderLoop& loop) {
          const std::string& camera = settings.camera;
          if (!camera.empty() && !find_camera(loop.scene().scene(), loop.scene().command(), camera))
            throw EmbedError(ORIEL_NOT_FOUND, "there is no camera " + camera);
          loop.set_view(settings);
          return loop.next_epoch();
        });
    embed::store_epoch(next, epoch);
  });
}

OrielResult oriel_session_status(OrielSession* session, OrielStatus* status) {
  return guarded([&] {
    const std::size_t size = required(status, "status").size;
    OrielStatus now = embed::session_of(session).status();
    now.size = size;
    std::memcpy(status, &now, std::min(size, sizeof now));
  });
}

OrielResult oriel_session_wait(OrielSession* session, uint32_t epoch, uint32_t samples,
                               double seconds) {
  return guarded([&] { embed::session_of(session).wait(epoch, samples, seconds); });
}

OrielResult oriel_session_save_picture(OrielSession* session, const char* path) {
  return guarded([&] {
    const std::string file = &required(path, "path");
    embed::session_of(session).run(TaskKind::Waits,
                                   [&](RenderLoop& loop) { embed::save_picture(loop, file); });
  });
}

OrielResult oriel_session_save_edits(OrielSession* session, const char* path) {
  return guarded([&] {
    const std::string file = &required(path, "path");
    embed::session_of(session).run(TaskKind::Reads, [&](RenderLoop& loop) {
      interactive::save_incremental(loop.scene(), file);
    });
  });
}

OrielResult oriel_session_messages(OrielSession* session,
                                   void (*message)(void*, OrielSeverity, const char*, const char*),
                                   void* user) {
  return guarded([&] {
    if (!message) throw EmbedError(ORIEL_BAD_ARGUMENT, "message is null");
    struct Line {
      OrielSeverity severity;
      std::string code, text;
    };
    const auto lines = embed::session_of(session).run(TaskKind::Waits, [](RenderLoop& loop) {
      std::vector<Line> list;
      const Diagnostics& all = loop.diagnostics();
      for (const Diagnostic& d : all.all())
        list.push_back({static_cast<OrielSeverity>(d.severity), d.code, all.format(d)});
      return list;
    });
    for (const Line& line : lines)
      message(user, line.severity, line.code.c_str(), line.text.c_str());
  });
}

OrielResult oriel_picture_acquire(OrielSession* session, OrielPicture** picture) {
  return guarded([&] {
    required(picture, "picture") = nullptr;
    auto newest = embed::session_of(session).picture();
    if (!newest) throw EmbedError(ORIEL_NO_PICTURE, "there is no picture yet");
    *picture = new OrielPicture{std::move(newest)};
  });
}

}  // extern "C"
