// SPDX-License-Identifier: Apache-2.0
// Elements that users' shaders make for themselves: blocks of bytes and trees of points.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "geom/point_tree.h"
#include "oriel/sdk/shader/types.h"

namespace oriel::sdk {

/// What mi_db_create and mi_kdtree_create made in one frame. Safe to use from all threads.
///
/// Checked: SdkElements, PointTree
class ShaderElements {
 public:
  /// Most bytes of one element.
  static constexpr std::size_t kMostBytes = std::size_t{1} << 30;

  /// A block of zeros; 0 where there is no room for it.
  miTag create(int type, std::size_t bytes);
  miTag create(std::shared_ptr<geom::PointTree> tree);
  /// False: there is no such block, or no room.
  bool resize(miTag tag, std::size_t bytes);
  /// False: there is no such block.
  bool erase(miTag tag);
  void erase_tree(miTag tag);
  void clear();

  /// Null: no such block.
  void* bytes(miTag tag);
  std::size_t size(miTag tag) const;
  int type(miTag tag) const;
  /// A tree, which stays until it is unpinned as often as pinned, also when it is erased; null: no
  /// such tree.
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
  std::size_t made_ = 0;  ///< tags are never given twice in a frame
};

}  // namespace oriel::sdk
