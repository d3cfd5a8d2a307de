#include "src/bench/meshes.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>

namespace ninebit::bench {
namespace {

constexpr std::uint32_t kNoVertex = 0xFFFFFFFF;

// Random numbers in [0, 1) that are the same on every machine, unlike those of the standard distributions.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  float operator()() { return static_cast<float>(engine_() >> 8U) / 16777216.0F; }
  bool coin() { return (engine_() & 1U) != 0; }

 private:
  std::mt19937 engine_;
};

ColorBytes color_of(std::size_t number) {
  const auto byte = [&](unsigned shift) { return static_cast<std::uint8_t>(number >> shift); };
  return {byte(0), byte(8), byte(16), 255};
}

struct Sheet {
  float angle;  // radians
  float depth;  // clip z
  bool front_facing;
};

void add_sheet(Mesh& mesh, const glm::vec2& window, float leg, const Sheet& sheet, Random& random) {
  const glm::vec2 across = glm::vec2(std::cos(sheet.angle), std::sin(sheet.angle)) * leg;
  const glm::vec2 along(-across.y, across.x);
  // A square that contains the window at every angle.
  const int reach = static_cast<int>(0.5F * glm::length(window) / leg) + 1;
  const auto jitter = [&] { return 0.6F * random() - 0.3F; };
  std::vector<std::uint32_t> last_row, row;
  for (int j = -reach; j <= reach; ++j) {
    row.clear();
    for (int i = -reach; i <= reach; ++i) {
      const float u = static_cast<float>(i) + jitter(), v = static_cast<float>(j) + jitter(), w = jitter();
      const glm::vec2 p = 0.5F * window + across * u + along * v;
      const bool inside = p.x >= 0.0F && p.y >= 0.0F && p.x <= window.x && p.y <= window.y;
      row.push_back(inside ? static_cast<std::uint32_t>(mesh.positions.size()) : kNoVertex);
      if (inside) mesh.positions.emplace_back(2.0F * p / window - 1.0F, sheet.depth + 0.1F * w);
    }
    for (std::size_t i = 0; i + 1 < last_row.size(); ++i) {
      std::array<std::uint32_t, 4> c{last_row[i], last_row[i + 1], row[i + 1], row[i]};
      if (c[0] == kNoVertex || c[1] == kNoVertex || c[2] == kNoVertex || c[3] == kNoVertex) continue;
      if (random.coin()) c = {c[1], c[2], c[3], c[0]};
      if (!sheet.front_facing) c = {c[0], c[3], c[2], c[1]};
      mesh.triangles.emplace_back(c[0], c[1], c[2]);
      mesh.triangles.emplace_back(c[0], c[2], c[3]);
    }
    last_row.swap(row);
  }
}

}  // namespace

Mesh small_triangles(int width, int height, float leg) {
  constexpr std::array kSheets{Sheet{0.35F, 0.0F, true}, Sheet{1.27F, 0.5F, false}, Sheet{2.3F, -0.5F, true}};
  const glm::vec2 window(static_cast<float>(width), static_cast<float>(height));
  Random random(1);
  Mesh mesh;
  for (const Sheet& sheet : kSheets) add_sheet(mesh, window, leg, sheet, random);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) mesh.colors.push_back(color_of(t + 1));
  return mesh;
}

Mesh large_triangles() {
  Mesh mesh;
  for (int sheet = 0; sheet < 32; ++sheet) {
    const float depth = 0.9F - 0.05F * static_cast<float>(sheet), tilt = 0.02F;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(
        mesh.positions.end(),
        {{-1.0F, -1.0F, depth - tilt}, {1.0F, -1.0F, depth}, {1.0F, 1.0F, depth + tilt}, {-1.0F, 1.0F, depth}});
    const std::uint32_t turn = sheet % 2 == 0 ? 0 : 1;
    const auto corner = [&](std::uint32_t i) { return first + (i + turn) % 4; };
    mesh.triangles.emplace_back(corner(0), corner(1), corner(2));
    mesh.triangles.emplace_back(corner(0), corner(2), corner(3));
    for (int k = 0; k < 2; ++k) mesh.colors.push_back(color_of(mesh.colors.size() * 7919 + 1));
  }
  return mesh;
}

ProvokingVertices provoking_vertices(std::span<const glm::uvec3> triangles, std::span<const ColorBytes> colors,
                                     std::size_t vertices) {
  ProvokingVertices result;
  result.source.resize(vertices);
  std::iota(result.source.begin(), result.source.end(), 0U);
  result.colors.resize(vertices, ColorBytes{});
  std::vector<bool> taken(vertices, false);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    glm::uvec3 triangle = triangles[t];
    const auto serves = [&](std::uint32_t v) { return !taken[v] || result.colors[v] == colors[t]; };
    for (int turns = 0; turns < 2 && !serves(triangle.z); ++turns) triangle = {triangle.y, triangle.z, triangle.x};
    if (!serves(triangle.z)) {
      result.source.push_back(triangle.z);
      triangle.z = static_cast<std::uint32_t>(result.colors.size());
      result.colors.emplace_back();
      taken.push_back(false);
    }
    taken[triangle.z] = true;
    result.colors[triangle.z] = colors[t];
    result.triangles.push_back(triangle);
  }
  return result;
}

}  // namespace ninebit::bench
