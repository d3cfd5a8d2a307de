#include "src/raster/draw/primitive_setup.h"

#include <bit>

#include "src/raster/lanes/triangle_batch.h"
#include "src/raster/setup/line_setup.h"

namespace ninebit {

bool PrimitiveSetup::takes_packed_vertices(const SetupContext& context, const PrimitiveAssembly& assembly,
                                           std::size_t vertices) {
  const bool is_triangles = assembly.type() == PrimitiveType::triangles ||
                            assembly.type() == PrimitiveType::triangle_strip ||
                            assembly.type() == PrimitiveType::triangle_fan;
  return is_triangles && context.fills() && !context.smooth_polygons && vertices > 0 && vertices <= kMaxPackedVertices;
}

PrimitiveSetup::PrimitiveSetup(const SetupContext& context, const PrimitiveAssembly& assembly,
                               const ClipPositions& clip, std::span<const PackedVertex> packed)
    : context_(context), assembly_(assembly), clip_(clip), packed_(packed) {
  if (assembly.type() == PrimitiveType::polygon && assembly.primitives() > 0) polygon_ = facts_of(0);
}

std::size_t PrimitiveSetup::items() const {
  return assembly_.type() == PrimitiveType::polygon ? assembly_.triangles_each() : assembly_.primitives();
}

std::size_t PrimitiveSetup::most_of_an_item() const {
  // Six planes make nine corners of a triangle: a fan of seven, or nine edges.
  constexpr std::size_t kPieces = 9;
  return assembly_.type() == PrimitiveType::polygon ? kPieces : kPieces * assembly_.triangles_each();
}

PolygonTriangle PrimitiveSetup::triangle_of(std::size_t primitive, std::size_t cut) const {
  PolygonTriangle t;
  const bool is_whole = assembly_.triangles_each() == 1;
  t.vertex = is_whole && assembly_.type() != PrimitiveType::polygon ? assembly_.triangle(primitive)
                                                                    : assembly_.triangle_of(primitive, cut);
  for (std::size_t i = 0; i < 3; ++i) t.clip[i] = clip_[t.vertex[i]];
  t.primitive = static_cast<std::uint32_t>(primitive);
  if (!is_whole) t.boundary = assembly_.boundary_of(cut);
  return t;
}

PolygonFacts PrimitiveSetup::facts_of(std::size_t primitive) const {
  if (context_.fills() && !context_.offset.fill) return {};
  PolygonSurvey survey(context_);
  for (std::size_t cut = 0; cut < assembly_.triangles_each(); ++cut) survey.add(triangle_of(primitive, cut));
  return survey.facts();
}

void PrimitiveSetup::set_up_polygons(std::size_t begin, std::size_t end, SetupBlock& block) const {
  if (assembly_.type() == PrimitiveType::polygon) {
    for (std::size_t cut = begin; cut < end; ++cut) set_up_triangle(context_, triangle_of(0, cut), polygon_, block);
    return;
  }
  for (std::size_t i = begin; i < end; ++i) {
    const PolygonFacts facts = facts_of(i);
    for (std::size_t cut = 0; cut < assembly_.triangles_each(); ++cut) {
      set_up_triangle(context_, triangle_of(i, cut), facts, block);
    }
  }
}

void PrimitiveSetup::set_up_one_by_one(std::size_t begin, std::size_t end, SetupBlock& block) const {
  switch (assembly_.type()) {
    case PrimitiveType::points:
      for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t v = assembly_.vertex(i);
        set_up_point(context_, clip_[v], v, static_cast<std::uint32_t>(i), block);
      }
      break;
    case PrimitiveType::lines:
    case PrimitiveType::line_strip:
    case PrimitiveType::line_loop:
      for (std::size_t i = begin; i < end; ++i) {
        const std::array<std::uint32_t, 2> v = assembly_.line(i);
        set_up_line(context_, {clip_[v[0]], clip_[v[1]]}, v, static_cast<std::uint32_t>(i), block);
      }
      break;
    default:
      set_up_polygons(begin, end, block);
  }
}

bool PrimitiveSetup::set_up_packed(std::size_t begin, std::size_t end, const TileGrid& grid, BinnedBlock& block) const {
  const TriangleBatch batch{context_, assembly_, packed_, grid.columns};
  while (begin < end) {
    const std::size_t count = block.tile.size();
    const auto resize = [&](std::size_t size) {
      block.setup.primitives.resize(size);
      if (context_.needs_corners) block.setup.corners.resize(size);
      block.tile.resize(size);
    };
    resize(count + end - begin);
    const TriangleBatchResult done =
        set_up_triangles(batch, begin, end,
                         {.primitives = &block.setup.primitives[count],
                          .corners = context_.needs_corners ? &block.setup.corners[count] : nullptr,
                          .tile = &block.tile[count]});
    resize(count + done.count);
    for (std::uint64_t left = done.left_over; left != 0; left &= left - 1) {
      const std::size_t i = done.first_left_over + static_cast<std::size_t>(std::countr_zero(left));
      set_up_polygons(i, i + 1, block.setup);
    }
    note_tiles(grid, block);
    if (done.is_beyond_vertices) return false;
    begin = done.next;
  }
  return true;
}

bool PrimitiveSetup::set_up(std::size_t begin, std::size_t end, const TileGrid& grid, BinnedBlock& block) const {
  if (!packed_.empty()) return set_up_packed(begin, end, grid, block);
  set_up_one_by_one(begin, end, block.setup);
  note_tiles(grid, block);
  return true;
}

}  // namespace ninebit
