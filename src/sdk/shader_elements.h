// SPDX-License-Identifier: Apache-2.0
// Elements created by user shaders: blocks of bytes and trees of points.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "geom/point_tree.h"
#include "oriel/sdk/shader/types.h"

namespace oriel::sdk {

/// Elements of mi_db_create and mi_kdtree_create in one frame. Thread-safe.
///
/// Checked: SdkElements, PointTree
class ShaderElements {
 public:
  /// Maximum size of an element in bytes.
  static constexpr std::size_t kMaxBytes = std::size_t{1} << 30;

  /// A zeroed block; 0 if out of memory.
  miTag create(int type, std::size_t bytes);
  miTag create(std::shared_ptr<geom::PointTree> tree);
  /// Returns false if there is no such block or no memory.
  bool resize(miTag tag, std::size_t bytes);
  /// Returns false if there is no such block.
  bool erase(miTag tag);
  void erase_tree(miTag tag);
  void clear();

  /// Null if there is no such block.
  void* bytes(miTag tag);
  std::size_t size(miTag tag) const;
  int type(miTag tag) const;
  /// A tree, which exists until each pin is undone, even if it is erased in between; null if there
  /// is none.
  geom::PointTree* pin(miTag tag);
  void unpin(const geom::PointTree* tree);

  struct Sum {
    std::size_t elements = 0, bytes = 0;
  };
  Sum sum() const;

 private:
  struct Free {
    void operator()(void* memory) const;
  };
  struct Element {
    int type = 0;
    std::unique_ptr<void, Free> bytes;
    std::size_t size = 0;
    std::shared_ptr<geom::PointTree> tree;
  };
  struct Pinned {
    std::shared_ptr<geom::PointTree> tree;
    std::size_t times = 0;
  };
  miTag add(Element element);
  const Element* find(miTag tag) const;

  mutable std::mutex mutex_;
  std::unordered_map<miTag, Element> elements_;
  std::unordered_map<const geom::PointTree*, Pinned> pinned_;
  std::size_t made_ = 0;  ///< tags are unique within a frame
};

}  // namespace oriel::sdk
