#include "src/raster/primitive_setup.h"

#include "src/raster/line_setup.h"

namespace ninebit {

PrimitiveSetup::PrimitiveSetup(const SetupContext& context, const PrimitiveAssembly& assembly,
                               std::span<const glm::vec4> clip)
    : context_(context), assembly_(assembly), clip_(clip) {
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
  if (context_.fills_without_offset()) return {};
  PolygonSurvey survey(context_);
  for (std::size_t cut = 0; cut < assembly_.triangles_each(); ++cut) survey.add(triangle_of(primitive, cut));
  return survey.facts();
}

void PrimitiveSetup::set_up_polygons(std::size_t begin, std::size_t end, SetupBlock& block) const {
  if (assembly_.type() == PrimitiveType::polygon) {
    for (std::size_t cut = begin; cut < end; ++cut) set_up_triangle(context_, triangle_of(0, cut), polygon_, block);
    return;
  }
  if (assembly_.triangles_each() == 1 && context_.fills_without_offset()) {
    for (std::size_t i = begin; i < end; ++i) set_up_triangle(context_, triangle_of(i, 0), {}, block);
    return;
  }
  for (std::size_t i = begin; i < end; ++i) {
    const PolygonFacts facts = facts_of(i);
    for (std::size_t cut = 0; cut < assembly_.triangles_each(); ++cut) {
      set_up_triangle(context_, triangle_of(i, cut), facts, block);
    }
  }
}

void PrimitiveSetup::set_up(std::size_t begin, std::size_t end, SetupBlock& block) const {
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

}  // namespace ninebit
