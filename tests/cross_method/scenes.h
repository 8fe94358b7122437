// SPDX-License-Identifier: Apache-2.0
// Scenes of the cross-method comparison: small rooms with one difficult feature each.
#pragma once

#include "comparison.h"

namespace oriel::cross_method {

// Conventions
//   y is up. Rooms span x -2..2, y -1.5..1.5, z -5..1; the camera stands at the origin and looks
//   along -z.

inline const Vec3 kLow(-2, -1.5f, -5), kHigh(2, 1.5f, 1);

/// Bounces are not cut: neither those of gather rays nor those of photons.
inline const std::string kOptions =
    "trace depth 8 8 12 shadow segments finalgather on finalgather accuracy 400 "
    "finalgather trace depth 4 4 12 16 globillum on photon trace depth 20 20 40";
/// More gather points, for light that changes within less than the room's tenth: 400 rays as
/// before, radii from 1 to 20 cm, a point for each pixel that asks for one.
inline const std::string kFine = "finalgather accuracy 400 .2 .01 finalgather presample density 16";

inline const std::string kCamera = "focal 1 aperture 1.5 aspect 1 resolution 40 40";

inline std::string physical(const std::string& color) {
  return "\"physical_light\" ( \"color\" " + color + " )";
}

/// Parameters of satin metal, up to the value of its glossiness.
inline constexpr const char* kSatin =
    "\"reflectivity\" .8, \"diffuse_weight\" 0, \"brdf_0_degree_refl\" 1, "
    "\"brdf_90_degree_refl\" 1, \"brdf_fresnel\" off, \"refl_gloss\" ";
inline constexpr const char* kVarnish =
    "\"diffuse\" .2 .15 .1, \"reflectivity\" 1, \"brdf_fresnel\" on, \"refr_ior\" 1.5, "
    "\"refl_gloss\" .3";

/// A wall in the plane of one axis, as four strips around a rectangular hole.
inline void wall_with_hole(SceneText& scene, const std::string& material, int axis, float at,
                           const Vec3& low, const Vec3& high, const Vec3& hole_low,
                           const Vec3& hole_high) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto strip = [&](float u0, float u1, float v0, float v1) {
    if (u1 <= u0 || v1 <= v0) return;
    const auto corner = [&](float a, float b) {
      Vec3 p(0);
      p[axis] = at, p[u] = a, p[v] = b;
      return p;
    };
    scene.polygon(material, {corner(u0, v0), corner(u1, v0), corner(u1, v1), corner(u0, v1)});
  };
  strip(low[u], hole_low[u], low[v], high[v]);
  strip(hole_high[u], high[u], low[v], high[v]);
  strip(hole_low[u], hole_high[u], low[v], hole_low[v]);
  strip(hole_low[u], hole_high[u], hole_high[v], high[v]);
}

/// One face of the room: axis 0..2, the lower or the upper one.
inline void face(SceneText& scene, const std::string& material, int axis, bool upper,
                 const Vec3& low = kLow, const Vec3& high = kHigh) {
  wall_with_hole(scene, material, axis, upper ? high[axis] : low[axis], low, high, high, high);
}

inline SceneText start(const std::string& options = {}) {
  SceneText scene(kOptions + " " + options);
  scene.camera(kCamera)
      .lambert("grey", .6f)
      .lambert("floor", .4f)
      .material("red", "\"reflectivity\" 0, \"diffuse\" .6 .1 .1")
      .material("green", "\"reflectivity\" 0, \"diffuse\" .1 .5 .1");
  return scene;
}

/// Coloured sides, grey ceiling, front and back; without the faces named in `open` ("x+", "y-").
inline void room(SceneText& scene, const std::string& open = {},
                 const std::string& floor = "floor") {
  const auto put = [&](const char* name, const std::string& material, int axis, bool upper) {
    if (open.find(name) == std::string::npos) face(scene, material, axis, upper);
  };
  put("x-", "red", 0, false);
  put("x+", "green", 0, true);
  put("y-", floor, 1, false);
  put("y+", "grey", 1, true);
  put("z-", "grey", 2, false);
  put("z+", "grey", 2, true);
}

inline void ceiling_light(SceneText& scene) {
  scene.light("lamp", physical("40 36 30") +
                          " origin 0 1.45 -2.5 direction 0 -1 0 rectangle .6 0 0 0 0 .6 2 2");
}

inline SceneText closed_box() {
  SceneText scene = start();
  room(scene);
  scene.box("grey", Vec3(-1.2f, -1.5f, -4), Vec3(-.3f, .1f, -3));
  ceiling_light(scene);
  return scene;
}

inline const Vec3 kWindowLow(2, -.3f, -3.5f), kWindowHigh(2, 1, -1.5f);

inline std::string physical_sky(const Vec3& to_sun) {
  return fmt::format(
      "\"mia_physicalsky\" ( \"y_is_up\" on, \"sun_direction\" {}, \"haze\" 2, "
      "\"sun_disk_intensity\" 0, \"sun_glow_intensity\" 0 )",
      text_of(to_sun));
}

inline SceneText room_with_window(const std::string& options = {}) {
  SceneText scene = start(options);
  room(scene, "x+");
  wall_with_hole(scene, "green", 0, 2, kLow, kHigh, kWindowLow, kWindowHigh);
  return scene;
}

inline SceneText sky_window() {
  SceneText scene = room_with_window(kFine);
  scene.environment(physical_sky(normalize(Vec3(-1, 1, 0))));
  return scene;
}

/// A portal in the window, its front to the room.
inline void add_portal(SceneText& scene) {
  const Vec3 middle = (kWindowLow + kWindowHigh) * .5f, size = kWindowHigh - kWindowLow;
  // The light's z is -x of the world, its x is z, its y is y.
  scene.light("portal",
              fmt::format("\"mia_portal_light\" ( \"cutoff_threshold\" 0 ) origin 0 0 0 rectangle "
                          "{} 0 0 0 {} 0 3 3",
                          size.z, size.y),
              fmt::format("visible on transform 0 0 -1 0  0 1 0 0  1 0 0 0  {} {} {} 1", -middle.z,
                          -middle.y, middle.x));
}

/// The same with a portal. Gathering finds light that changes slowly, so the usual points do.
inline SceneText sky_portal() {
  SceneText scene = room_with_window();
  scene.environment(physical_sky(normalize(Vec3(-1, 1, 0))));
  add_portal(scene);
  return scene;
}

inline SceneText sunlit_room(const std::string& options = {}) {
  SceneText scene = room_with_window(options);
  return scene.light("sun", "\"mia_physicalsun\" ( \"y_is_up\" on, \"haze\" 2 ) direction " +
                                text_of(normalize(Vec3(-1, -.7f, -.2f))));
}

inline SceneText sun_window() { return sunlit_room(); }

/// Sun and sky through the window on a table, shelves with books and a thin partition: many edges,
/// and things that are thinner than the disc of a photon estimate.
inline SceneText furnished() {
  SceneText scene = room_with_window(kFine);
  scene.environment(physical_sky(normalize(Vec3(1, .7f, .2f))))
      .light("sun", "\"mia_physicalsun\" ( \"y_is_up\" on, \"haze\" 2 ) direction " +
                        text_of(normalize(Vec3(-1, -.7f, -.2f))))
      .box("grey", Vec3(-.6f, -.8f, -3.4f), Vec3(.8f, -.75f, -2.4f))
      .box("red", Vec3(-1.9f, -1.5f, -3), Vec3(-1.85f, .4f, -1.6f));
  for (const float x : {-.55f, .7f})
    for (const float z : {-3.35f, -2.5f})
      scene.box("grey", Vec3(x, -1.5f, z), Vec3(x + .06f, -.8f, z + .06f));
  for (int k = 0; k < 4; ++k) {
    const float y = -1.2f + .6f * static_cast<float>(k);
    scene.box("floor", Vec3(-1.4f, y, -4.95f), Vec3(1.4f, y + .03f, -4.6f));
    for (int i = 0; i < 6; ++i) {
      const float x = -1.3f + .43f * static_cast<float>(i) + .05f * static_cast<float>(k);
      scene.box(i % 2 ? "green" : "grey", Vec3(x, y + .03f, -4.9f),
                Vec3(x + .04f, y + .3f, -4.65f));
    }
  }
  return scene;
}

/// The same on wide land: radii must follow the room, and not all of the scene.
inline SceneText furnished_on_land() {
  SceneText scene = furnished();
  scene.square("floor", Vec3(0, -1.7f, 0), 60, Vec3(0, 1, 0));
  return scene;
}

inline SceneText glossy_corner() {
  SceneText scene = start();
  scene.material("polished",
                 "\"reflectivity\" .5, \"diffuse\" .4 .35 .3, \"refl_gloss\" .6, "
                 "\"brdf_0_degree_refl\" .3, \"brdf_90_degree_refl\" 1, \"brdf_curve\" 5");
  room(scene, "x+ z+ y+", "polished");
  scene.light("lamp",
              physical("60 60 60") +
                  " origin 1 1.4 -1.5 direction -.5 -1 -.5 rectangle .8 -.4 0 0 -.4 .8 2 2");
  return scene;
}

inline SceneText glass_on_table() {
  SceneText scene = start();
  room(scene);
  scene
      .material("glass",
                "\"reflectivity\" 1, \"transparency\" 1, \"diffuse_weight\" 0, \"refr_ior\" 1.5, "
                "\"brdf_fresnel\" on, \"refr_color\" .8 .9 .95")
      .box("floor", Vec3(-1, -.7f, -3.6f), Vec3(1, -.6f, -2))
      .sphere("glass", Vec3(-.3f, -.25f, -2.6f), .34f, 24)
      .box("glass", Vec3(.25f, -.59f, -3), Vec3(.65f, 0, -2.6f));
  ceiling_light(scene);
  return scene;
}

inline SceneText curtain() {
  SceneText scene = room_with_window(kFine);
  scene
      .material("curtain",
                "\"reflectivity\" 0, \"diffuse\" .8 .8 .7, \"transparency\" .6, "
                "\"refr_translucency\" on, \"refr_trans_weight\" 1, \"refr_trans_color\" .9 .9 .8, "
                "\"thin_walled\" on")
      .polygon("curtain", {Vec3(1.8f, -.6f, -3.9f), Vec3(1.8f, -.6f, -1.1f),
                           Vec3(1.8f, 1.3f, -1.1f), Vec3(1.8f, 1.3f, -3.9f)})
      .environment(physical_sky(normalize(Vec3(-1, 1, 0))));
  return scene;
}

inline SceneText glowing_sphere() {
  SceneText scene = start();
  scene.emitter("glow", 4);
  room(scene, "z+ x+");
  scene.sphere("glow", Vec3(.2f, -1, -3), .5f, 24);
  return scene;
}

/// A point light in the next room lights the room of the camera through a door.
inline SceneText two_rooms() {
  SceneText scene = start();
  room(scene, "x+");
  wall_with_hole(scene, "grey", 0, 2, kLow, kHigh, Vec3(2, -1.5f, -3.6f), Vec3(2, .8f, -2.4f));
  const Vec3 low(2, -1.5f, -5), high(6, 1.5f, 1);
  for (const int axis : {1, 2})
    for (const bool upper : {false, true}) face(scene, "grey", axis, upper, low, high);
  face(scene, "grey", 0, true, low, high);
  scene.light("lamp", physical("200 190 170") +
                          " origin 4 1.45 -2.5 direction 0 -1 0 rectangle .6 0 0 0 0 .6 2 2");
  return scene;
}

}  // namespace oriel::cross_method
