// SPDX-License-Identifier: Apache-2.0
#include "models/views_3ds.h"

#include <assimp/scene.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>

namespace oriel::models {
namespace {

/// Chunk types on the path to cameras and lights.
enum Chunk : std::uint16_t {
  kMain = 0x4d4d,
  kEdit = 0x3d3d,
  kNamed = 0x4000,
  kLight = 0x4600,
  kSpot = 0x4610,
  kCamera = 0x4700
};

constexpr float kDegree = 3.14159265f / 180;
/// Field of view in degrees times focal length of a lens.
constexpr float kLens = 2400;

/// A camera or light in the space of the file.
struct View {
  aiVector3D position, target;
  float roll = 0, lens = 0;    ///< degrees, millimetres
  float inner = 0, outer = 0;  ///< full cone angles of a spot in degrees
  bool aimed = false;          ///< it has a target
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}

  bool at_end() const { return rest_.empty(); }
  std::uint32_t number(std::size_t size) {
    if (rest_.size() < size) {
      rest_ = {};
      return 0;
    }
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
      value |= std::uint32_t{static_cast<unsigned char>(rest_[i])} << (8 * i);
    rest_.remove_prefix(size);
    return value;
  }
  float real() {
    const auto value = std::bit_cast<float>(number(4));
    return std::isfinite(value) ? value : 0;
  }
  aiVector3D vector() {
    const float x = real(), y = real(), z = real();
    return {x, y, z};
  }
  std::string word() {
    const std::size_t end = std::min(rest_.find('\0'), rest_.size());
    std::string text(rest_.substr(0, end));
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return text;
  }
  /// Calls use(type, Reader of the content) for each chunk.
  template <class F>
  void chunks(F&& use) {
    constexpr std::uint32_t kHead = 6;
    while (!at_end()) {
      const auto kind = static_cast<std::uint16_t>(number(2));
      const std::uint32_t size = number(4);
      if (size < kHead) return;
      const std::string_view content = rest_.substr(0, size - kHead);
      rest_.remove_prefix(content.size());
      use(kind, Reader(content));
    }
  }

 private:
  std::string_view rest_;
};

std::map<std::string, View> views_of(const std::string& bytes) {
  std::map<std::string, View> views;
  const auto named = [&](Reader in) {
    const std::string name = in.word();
    in.chunks([&](std::uint16_t kind, Reader what) {
      View view;
      if (kind == kCamera) {
        view.position = what.vector();
        view.target = what.vector();
        view.roll = what.real();
        view.lens = what.real();
        view.aimed = true;
      } else if (kind == kLight) {
        view.position = what.vector();
        what.chunks([&](std::uint16_t part, Reader spot) {
          if (part != kSpot) return;
          view.target = spot.vector();
          view.inner = spot.real();
          view.outer = std::max(spot.real(), view.inner);
          view.aimed = true;
        });
      } else {
        return;
      }
      views.try_emplace(name, view);
    });
  };
  Reader(bytes).chunks([&](std::uint16_t main, Reader content) {
    if (main != kMain) return;
    content.chunks([&](std::uint16_t edit, Reader parts) {
      if (edit != kEdit) return;
      parts.chunks([&](std::uint16_t kind, Reader in) {
        if (kind == kNamed) named(in);
      });
    });
  });
  return views;
}

/// Transform from root space to the space of a node; identity if the node is missing or singular.
aiMatrix4x4 into_node(const aiScene& model, const aiString& name) {
  aiMatrix4x4 to_root;
  for (const aiNode* node = model.mRootNode->FindNode(name); node && node->mParent;
       node = node->mParent)
    to_root = node->mTransformation * to_root;
  return to_root.Determinant() != 0 ? to_root.Inverse() : aiMatrix4x4();
}

}  // namespace

void mend_views_3ds(aiScene& model, const std::string& bytes) {
  if (!model.mRootNode) return;
  const std::map<std::string, View> views = views_of(bytes);
  const auto view_of = [&](const aiString& name) -> const View* {
    const auto found = views.find(name.C_Str());
    return found == views.end() ? nullptr : &found->second;
  };
  for (unsigned i = 0; i < model.mNumCameras; ++i) {
    aiCamera& camera = *model.mCameras[i];
    const View* view = view_of(camera.mName);
    if (!view) continue;
    const aiMatrix4x4 to_node = into_node(model, camera.mName);
    const aiVector3D look = view->target - view->position;
    aiMatrix4x4 roll;
    if (look.SquareLength() > 0)
      aiMatrix4x4::Rotation(view->roll * kDegree, aiVector3D(look).Normalize(), roll);
    // For a vertical view direction, use another up vector.
    const bool upright = look.x * look.x + look.y * look.y > 1e-12f * look.SquareLength();
    const aiVector3D up = roll * (upright ? aiVector3D(0, 0, 1) : aiVector3D(0, 1, 0));
    camera.mPosition = to_node * view->position;
    if (look.SquareLength() > 0) camera.mLookAt = aiMatrix3x3(to_node) * look;
    camera.mUp = aiMatrix3x3(to_node) * up;
    if (view->lens > 0) camera.mHorizontalFOV = kLens / view->lens * kDegree;
  }
  for (unsigned i = 0; i < model.mNumLights; ++i) {
    aiLight& light = *model.mLights[i];
    const View* view = view_of(light.mName);
    if (!view) continue;
    const aiMatrix4x4 to_node = into_node(model, light.mName);
    light.mPosition = to_node * view->position;
    if (!view->aimed) continue;
    light.mDirection = aiMatrix3x3(to_node) * (view->target - view->position);
    light.mAngleInnerCone = view->inner / 2 * kDegree;
    light.mAngleOuterCone = view->outer / 2 * kDegree;
  }
}

}  // namespace oriel::models
