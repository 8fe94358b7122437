// SPDX-License-Identifier: Apache-2.0
#include "bench_scenes.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <random>

#include "base/vec.h"

namespace oriel::bench {
namespace {

using Text = std::back_insert_iterator<std::string>;

float height(int x, int y) {
  return 0.25f * std::sin(0.05f * static_cast<float>(x)) * std::cos(0.07f * static_cast<float>(y));
}

void write_point(Text out, int x, int y) {
  fmt::format_to(out, "{:.6g} {:.6g} {:.6g}\n", static_cast<float>(x) * 0.013f, height(x, y),
                 static_cast<float>(y) * 0.013f);
}

constexpr const char* kOptions = R"(link "base.so"
link "architectural.so"
$include <base.mi>
$include <architectural.mi>
options "options"
  object space
  trace on
  trace depth 8 8 12
  shadow segments
  "indirect" "path"
end options
)";

constexpr const char* kRoom = R"(
light "lamp" "physical_light" ( "color" 250 220 180 )
  origin 0 0 0
  rectangle 1 0 0 0 -1 0
end light
instance "lamp_inst" "lamp" transform 1 0 0 0 0 1 0 0 0 0 1 0 -3 -2.5 -2.95 1 end instance
camera "camera"
  output "rgba_fp" "exr" "room.exr"
  focal 25 aperture 36 aspect 1.5 resolution 480 320
end camera
instance "camera_inst" "camera"
  transform 1 0 0 0 0 0 -1 0 0 1 0 0 -3 -1.5 0.1 1
end instance
shader "white_s" "mia_material_x" ( "diffuse" .75 .75 .75, "reflectivity" 0 )
shader "red_s" "mia_material_x" ( "diffuse" .6 .1 .1, "reflectivity" 0 )
shader "green_s" "mia_material_x" ( "diffuse" .1 .5 .1, "reflectivity" 0 )
shader "gloss_s" "mia_material_x" (
  "diffuse" .3 .3 .5, "reflectivity" 1, "refl_gloss" .6, "brdf_fresnel" on, "refr_ior" 1.5 )
shader "glass_s" "mia_material_x" (
  "diffuse_weight" 0, "reflectivity" 1, "refl_gloss" 1, "transparency" 1, "refr_ior" 1.5,
  "brdf_fresnel" on )
material "white" = "white_s" end material
material "red" = "red_s" end material
material "green" = "green_s" end material
material "gloss" = "gloss_s" end material
material "glass" = "glass_s" shadow = "glass_s" end material
)";

/// An object of quads, each with its material.
class Quads {
 public:
  void add(const char* material, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    for (const Vec3& p : {a, b, c, d})
      fmt::format_to(std::back_inserter(points_), "{:.6g} {:.6g} {:.6g}\n", p.x, p.y, p.z);
    fmt::format_to(std::back_inserter(polygons_), "p \"{}\" {} {} {} {}\n", material, count_,
                   count_ + 1, count_ + 2, count_ + 3);
    count_ += 4;
  }
  /// `inside`: seen from within, and the wall at low x red, the one at high x green.
  void add_box(const char* material, const Vec3& low, const Vec3& high, bool inside) {
    const auto corner = [&](int i) {
      return Vec3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    };
    constexpr std::array<std::array<int, 4>, 6> kSides = {
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (std::size_t i = 0; i < kSides.size(); ++i) {
      auto [a, b, c, d] = kSides[i];
      if (inside) std::swap(b, d);
      const char* const side = inside && i == 0 ? "red" : inside && i == 1 ? "green" : material;
      add(side, corner(a), corner(b), corner(c), corner(d));
    }
  }
  std::string object(const char* name) const {
    std::string vertices;
    for (int i = 0; i < count_; ++i) fmt::format_to(std::back_inserter(vertices), "v {}\n", i);
    return fmt::format(
        "object \"{0}\" visible on shadow on trace on group\n{1}{2}{3}end group end object\n"
        "instance \"{0}_inst\" \"{0}\" end instance\n",
        name, points_, vertices, polygons_);
  }

 private:
  std::string points_, polygons_;
  int count_ = 0;
};

Quads room_walls() {
  Quads quads;
  quads.add_box("white", Vec3(0), Vec3(6, 5, 3), true);
  return quads;
}

void write_ball(std::string& text, const std::string& name, const char* material,
                const Vec3& center, float size) {
  constexpr int kRings = 100, kColumns = 200;
  // A small hole at each pole, so that no triangle is without area.
  constexpr float kHole = 0.02f;
  const Text out = std::back_inserter(text);
  fmt::format_to(out, "object \"{}\" visible on shadow on trace on group\n", name);
  const auto normal = [](int i, int j) {
    const float theta = kHole + (kPi - 2 * kHole) * static_cast<float>(i) / kRings;
    const float phi = kTwoPi * static_cast<float>(j) / kColumns;
    return Vec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
  };
  for (int i = 0; i <= kRings; ++i)
    for (int j = 0; j < kColumns; ++j) {
      const float wave = std::sin(0.4f * static_cast<float>(i)) *
                         std::sin(20 * kTwoPi * static_cast<float>(j) / kColumns);
      const Vec3 p = center + normal(i, j) * (size * (1 + 0.02f * wave));
      fmt::format_to(out, "{:.6g} {:.6g} {:.6g}\n", p.x, p.y, p.z);
    }
  constexpr int kPoints = (kRings + 1) * kColumns;
  for (int i = 0; i <= kRings; ++i)
    for (int j = 0; j < kColumns; ++j) {
      const Vec3 n = normal(i, j);
      fmt::format_to(out, "{:.5g} {:.5g} {:.5g}\n", n.x, n.y, n.z);
    }
  for (int i = 0; i < kPoints; ++i) fmt::format_to(out, "v {} n {}\n", i, kPoints + i);
  const auto at = [](int i, int j) { return i * kColumns + j % kColumns; };
  const char* named = material;  // a polygon without a name inherits the last one's
  for (int i = 0; i < kRings; ++i)
    for (int j = 0; j < kColumns; ++j) {
      const int a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if (named)
        fmt::format_to(out, "p \"{}\" {} {} {}\np {} {} {}\n", named, a, b, c, a, c, d);
      else
        fmt::format_to(out, "p {} {} {}\np {} {} {}\n", a, b, c, a, c, d);
      named = nullptr;
    }
  fmt::format_to(out, "end group end object\ninstance \"{0}_inst\" \"{0}\" end instance\n", name);
}

std::string whole(std::string body, const std::string& instances) {
  return kOptions + std::string(kRoom) + std::move(body) +
         "instgroup \"world\" \"camera_inst\" \"lamp_inst\" " + instances +
         " end instgroup\nrender \"world\" \"camera_inst\" \"options\"\n";
}

}  // namespace

std::string shared_vertices(int side) {
  std::string text = "object \"o\" visible trace shadow\ngroup\n";
  const Text out = std::back_inserter(text);
  for (int y = 0; y <= side; ++y)
    for (int x = 0; x <= side; ++x) write_point(out, x, y);
  for (int i = 0; i < (side + 1) * (side + 1); ++i) fmt::format_to(out, "v {}\n", i);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const int a = y * (side + 1) + x, b = a + 1, c = a + side + 2, d = a + side + 1;
      fmt::format_to(out, "p {} {} {}\np {} {} {}\n", a, b, c, a, c, d);
    }
  return text + "end group\nend object\n";
}

std::string vertex_per_corner(int side) {
  std::string text = "object \"o\" visible trace shadow\ngroup\n";
  const Text out = std::back_inserter(text);
  const int points = (side + 1) * (side + 1);
  for (int y = 0; y <= side; ++y)
    for (int x = 0; x <= side; ++x) write_point(out, x, y);
  for (int y = 0; y <= side; ++y)
    for (int x = 0; x <= side; ++x)
      fmt::format_to(out, "{:.5f} {:.5f} {:.5f}\n", height(y, x), 1 - height(x, x), height(y, y));
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const int a = y * (side + 1) + x, b = a + 1, c = a + side + 2, d = a + side + 1;
      for (const int i : {a, b, c, a, c, d})
        fmt::format_to(out, "v {} n {} t {}\n", i, points + i, i);
    }
  for (int corner = 0; corner < 6 * side * side; corner += 3)
    fmt::format_to(out, "p \"m\" {} {} {}\n", corner, corner + 1, corner + 2);
  return text + "end group\nend object\n";
}

std::string around_object(const std::string& object) {
  return whole("material \"m\" = \"white_s\" end material\n" + object +
                   "instance \"o_inst\" \"o\" end instance\n",
               "\"o_inst\"");
}

std::string wall_of_terrains(int side, int count) {
  const int across = static_cast<int>(std::ceil(std::sqrt(static_cast<float>(count))));
  const float size = 6 / static_cast<float>(across);             // metres, of each
  const float scale = 0.013f * static_cast<float>(side) / size;  // from the world to the object
  std::string body = "material \"m\" = \"white_s\" end material\n" + shared_vertices(side);
  std::string names;
  for (int i = 0; i < count; ++i) {
    const int column = i % across, row = i / across;
    const Vec3 at(size * static_cast<float>(column), 4, size * static_cast<float>(row));
    fmt::format_to(std::back_inserter(body),
                   "instance \"i{}\" \"o\" material \"m\" transform "
                   "{:.6g} 0 0 0 0 {:.6g} 0 0 0 0 {:.6g} 0 {:.6g} {:.6g} {:.6g} 1 end instance\n",
                   i, scale, scale, scale, -at.x * scale, -at.y * scale, -at.z * scale);
    fmt::format_to(std::back_inserter(names), "\"i{}\"\n", i);
  }
  return whole(std::move(body), names);
}

std::string room_of_pictures(int count, float filter) {
  const int across = static_cast<int>(std::ceil(std::sqrt(static_cast<float>(count))));
  const int deep = (across + 1) / 2;
  std::string body = "shader \"uv\" \"mib_texture_vector\" ( \"select\" 0 )\n", polygons, points;
  const float width = 6 / static_cast<float>(across), depth = 3.8f / static_cast<float>(deep);
  int vertices = 0;
  for (int i = 0; i < count; ++i) {
    fmt::format_to(std::back_inserter(body),
                   "filter {} color texture \"t{}\" \"{}.exr\"\n"
                   "shader \"l{}\" \"mib_texture_lookup\" ( \"tex\" \"t{}\", \"coord\" = \"uv\" )\n"
                   "shader \"s{}\" \"mib_illum_lambert\" ( \"diffuse\" = \"l{}\" )\n"
                   "material \"m{}\" = \"s{}\" end material\n",
                   filter, i, i, i, i, i, i, i, i);
    const bool floor = i / across < deep;
    const int row = floor ? i / across : i / across - deep;
    for (int corner = 0; corner < 4; ++corner) {
      const bool right = corner == 1 || corner == 2, far = corner > 1;
      const float x = width * static_cast<float>(i % across + (right ? 1 : 0));
      const float away = depth * static_cast<float>(row + (far ? 1 : 0));
      fmt::format_to(std::back_inserter(points), "{:.6g} {:.6g} {:.6g}\n", x,
                     floor ? .2f + away : 4, floor ? 0 : away);
    }
    fmt::format_to(std::back_inserter(polygons), "p \"m{}\" {} {} {} {}\n", i, vertices,
                   vertices + 1, vertices + 2, vertices + 3);
    vertices += 4;
  }
  body += "object \"o\" visible trace shadow\ngroup\n" + points + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  for (int i = 0; i < vertices; ++i)
    fmt::format_to(std::back_inserter(body), "v {} t {}\n", i, vertices + i % 4);
  body += polygons + "end group\nend object\ninstance \"o_inst\" \"o\" end instance\n";
  return whole(std::move(body), "\"o_inst\"");
}

std::string small_room() {
  Quads quads = room_walls();
  quads.add_box("white", Vec3(1, 2.5f, 0), Vec3(2.4f, 3.9f, 1.8f), false);
  quads.add_box("gloss", Vec3(3.4f, 1.6f, 0), Vec3(4.6f, 2.8f, 0.9f), false);
  return whole(quads.object("room"), "\"room_inst\"");
}

std::string big_room() {
  std::string body = room_walls().object("room");
  std::string instances = "\"room_inst\"";
  std::mt19937 random(2);
  std::uniform_real_distribution<float> unit(0, 1);
  constexpr const char* kMaterials[] = {"white", "gloss", "red", "gloss", "green", "glass"};
  for (int ball = 0; ball < 27; ++ball) {
    const std::string name = fmt::format("ball{}", ball);
    const float size = 0.2f + 0.3f * unit(random);
    const Vec3 center(0.6f + 4.8f * unit(random), 1.5f + 2.9f * unit(random),
                      0.5f + 1.8f * unit(random));
    write_ball(body, name, kMaterials[ball % 6], center, size);
    instances += fmt::format(" \"{}_inst\"", name);
  }
  return whole(std::move(body), instances);
}

std::string sky_lit_room(bool portal, const std::string& floor, const std::string& walls) {
  const float x = 2, y0 = -1.5f, y1 = 1.5f, z0 = -5, z1 = 1;
  const float low = -.3f, high = 1, back = -3.5f, front = -1.5f;  // the window at x
  Quads quads;
  const auto side = [&](const char* material, float at, float ya, float yb, float za, float zb) {
    quads.add(material, Vec3(at, ya, za), Vec3(at, ya, zb), Vec3(at, yb, zb), Vec3(at, yb, za));
  };
  const auto level = [&](const char* material, float at) {
    quads.add(material, Vec3(-x, at, z0), Vec3(x, at, z0), Vec3(x, at, z1), Vec3(-x, at, z1));
  };
  const auto across = [&](float at) {
    quads.add("grey", Vec3(-x, y0, at), Vec3(x, y0, at), Vec3(x, y1, at), Vec3(-x, y1, at));
  };
  side("red", -x, y0, y1, z0, z1);
  side("green", x, y0, low, z0, z1);
  side("green", x, high, y1, z0, z1);
  side("green", x, low, high, z0, back);
  side("green", x, low, high, front, z1);
  level("floor", y0);
  level("grey", y1);
  across(z0);
  across(z1);

  std::string text =
      "link \"base.so\"\nlink \"architectural.so\"\n"
      "$include <base.mi>\n$include <architectural.mi>\n"
      "options \"options\" object space trace on trace depth 8 8 12 "
      "finalgather on finalgather trace depth 4 4 12 16 end options\n"
      "shader \"sky\" \"mia_physicalsky\" ( \"y_is_up\" on, \"sun_direction\" -.7071 .7071 0, "
      "\"haze\" 2, \"sun_disk_intensity\" 0, \"sun_glow_intensity\" 0 )\n"
      "camera \"camera\" environment = \"sky\" focal 1 aperture 1.5 aspect 1.333333 "
      "resolution 320 240 end camera\n"
      "instance \"camera_inst\" \"camera\" end instance\n";
  const auto material = [&](const char* name, const char* diffuse, const std::string& more) {
    text += fmt::format(
        "shader \"{0}_s\" \"mia_material_x\" ( \"diffuse\" {1}, {2} )\n"
        "material \"{0}\" = \"{0}_s\" shadow = \"{0}_s\" end material\n",
        name, diffuse, more);
  };
  material("grey", ".6 .6 .6", walls);
  material("red", ".6 .1 .1", walls);
  material("green", ".1 .5 .1", walls);
  material("floor", ".4 .4 .4", floor);
  text += quads.object("room");
  if (portal)
    text += fmt::format(
        "light \"portal\" \"mia_portal_light\" ( \"cutoff_threshold\" 0 ) origin {} {} {} "
        "rectangle 0 0 {} 0 {} 0 3 3 end light\n"
        "instance \"portal_inst\" \"portal\" visible on end instance\n",
        x, (low + high) / 2, (back + front) / 2, front - back, high - low);
  return text + "instgroup \"world\" \"camera_inst\" \"room_inst\"" +
         (portal ? " \"portal_inst\"" : "") +
         " end instgroup\nrender \"world\" \"camera_inst\" \"options\"\n";
}

}  // namespace oriel::bench
