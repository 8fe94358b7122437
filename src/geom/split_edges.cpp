// SPDX-License-Identifier: Apache-2.0
#include "geom/split_edges.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace oriel::geom {

namespace {

void sort_unique(std::vector<std::uint64_t>& keys) {
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

template <typename Function>
void for_each_column(Mesh& mesh, Function&& function) {
  for (TextureSpace& space : mesh.textures) {
    function(space.coordinate);
    function(space.basis_u);
    function(space.basis_v);
  }
  function(mesh.dpdu);
  function(mesh.dpdv);
  for (std::vector<Vec3>& step : mesh.motion) function(step);
}

}  // namespace

std::uint32_t number_places(const Mesh& mesh, std::vector<std::uint32_t>& place) {
  const std::vector<Vec3>& p = mesh.positions;
  std::vector<std::uint32_t> order(mesh.vertex_count());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (p[a].x != p[b].x) return p[a].x < p[b].x;
    if (p[a].y != p[b].y) return p[a].y < p[b].y;
    return p[a].z < p[b].z;
  });
  place.resize(order.size());
  std::uint32_t places = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || p[order[i]] != p[order[i - 1]]) ++places;
    place[order[i]] = places - 1;
  }
  return places;
}

EdgeSplitter::EdgeSplitter(Mesh& mesh) : mesh_(mesh), places_(number_places(mesh, place_)) {}

std::uint32_t EdgeSplitter::rank(const std::vector<Key>& keys, Key k) {
  const auto found = std::lower_bound(keys.begin(), keys.end(), k);
  return found != keys.end() && *found == k ? static_cast<std::uint32_t>(found - keys.begin())
                                            : kNone;
}

bool EdgeSplitter::split(std::vector<Key> marked, std::size_t most) {
  if (marked.empty()) return false;
  sort_unique(marked);
  // The same edges as pairs of vertices.
  std::vector<Key> edges;
  std::size_t total = mesh_.triangles.size();
  for (const Triangle& t : mesh_.triangles)
    for (const auto& [a, b] : {std::pair{t.a, t.b}, {t.b, t.c}, {t.c, t.a}})
      if (rank(marked, key(place_[a], place_[b])) != kNone) {
        edges.push_back(key(a, b));
        ++total;
      }
  if (total > most) {
    exceeded = true;
    return false;
  }
  sort_unique(edges);
  add_vertices(marked, edges);
  cut_triangles(edges, total);
  return true;
}

void EdgeSplitter::add_vertices(const std::vector<Key>& marked, const std::vector<Key>& edges) {
  const auto middle = [&](std::vector<Vec3>& column, auto&& mean) {
    column.reserve(column.size() + edges.size() + 1);
    for (const Key e : edges) {
      const Vec3 a = column[e >> 32], b = column[static_cast<std::uint32_t>(e)];
      column.push_back(mean(a, b));
    }
  };
  const auto half = [](const Vec3& a, const Vec3& b) { return (a + b) * .5f; };
  mesh_.positions.pop_back();
  middle(mesh_.positions, half);
  mesh_.positions.push_back(Vec3(0));
  if (!mesh_.normals.empty())
    middle(mesh_.normals, [](const Vec3& a, const Vec3& b) {
      return a == Vec3(0) || b == Vec3(0) ? Vec3(0) : normalize(a + b);
    });
  for_each_column(mesh_, [&](std::vector<Vec3>& column) {
    if (!column.empty()) middle(column, half);
  });
  place_.reserve(place_.size() + edges.size());
  for (const Key e : edges)
    place_.push_back(places_ +
                     rank(marked, key(place_[e >> 32], place_[static_cast<std::uint32_t>(e)])));
  places_ += static_cast<std::uint32_t>(marked.size());
}

void EdgeSplitter::cut_triangles(const std::vector<Key>& edges, std::size_t total) {
  const auto base =
      // index of the first new vertex
      static_cast<std::uint32_t>(mesh_.vertex_count() - edges.size());
  std::vector<Triangle> cut;
  std::vector<std::uint32_t> slot;
  cut.reserve(total);
  if (!mesh_.slot.empty()) slot.reserve(total);
  const auto distance = [this](std::uint32_t a, std::uint32_t b) {
    return length(mesh_.positions[b] - mesh_.positions[a]);
  };
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
    const Triangle& t = mesh_.triangles[i];
    // Corners v; m is the middle of the side from v[k] to v[k + 1] if it is split.
    std::array<std::uint32_t, 3> v{t.a, t.b, t.c}, m{};
    unsigned count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t r = rank(edges, key(v[k], v[(k + 1) % 3]));
      m[k] = r == kNone ? kNone : base + r;
      count += r != kNone;
    }
    // Rotate so that a single split side is the first, and two split sides are the first two.
    const auto turn = [&] {
      std::rotate(v.begin(), v.begin() + 1, v.end());
      std::rotate(m.begin(), m.begin() + 1, m.end());
    };
    if (count == 1)
      while (m[0] == kNone) turn();
    if (count == 2)
      while (m[2] != kNone) turn();
    if (count == 0) {
      cut.push_back(t);
    } else if (count == 1) {
      cut.insert(cut.end(), {{v[0], m[0], v[2]}, {m[0], v[1], v[2]}});
    } else if (count == 2) {
      cut.push_back({m[0], v[1], m[1]});
      if (distance(v[0], m[1]) < distance(m[0], v[2]))
        cut.insert(cut.end(), {{v[0], m[0], m[1]}, {v[0], m[1], v[2]}});
      else
        cut.insert(cut.end(), {{v[0], m[0], v[2]}, {m[0], m[1], v[2]}});
    } else {
      cut.insert(cut.end(),
                 {{v[0], m[0], m[2]}, {m[0], v[1], m[1]}, {m[2], m[1], v[2]}, {m[0], m[1], m[2]}});
    }
    if (!mesh_.slot.empty()) slot.resize(cut.size(), mesh_.slot[i]);
  }
  mesh_.triangles = std::move(cut);
  mesh_.slot = std::move(slot);
}

void add_facet_normals(Mesh& mesh) {
  if (!mesh.normals.empty()) return;
  std::vector<std::uint32_t> from;
  from.reserve(mesh.triangles.size() * 3);
  for (Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.positions[t.a];
    const Vec3 normal = normalize(cross(mesh.positions[t.b] - a, mesh.positions[t.c] - a));
    const auto first = static_cast<std::uint32_t>(from.size());
    from.insert(from.end(), {t.a, t.b, t.c});
    mesh.normals.insert(mesh.normals.end(), 3, normal);
    t = {first, first + 1, first + 2};
  }
  const auto gather = [&from](std::vector<Vec3>& column) {
    if (column.empty()) return;
    std::vector<Vec3> gathered;
    gathered.reserve(from.size() + 1);
    for (const std::uint32_t v : from) gathered.push_back(column[v]);
    column = std::move(gathered);
  };
  gather(mesh.positions);
  mesh.positions.push_back(Vec3(0));
  for_each_column(mesh, gather);
}

}  // namespace oriel::geom
